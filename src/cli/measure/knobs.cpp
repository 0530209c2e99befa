#include "cli/measure/knobs.hpp"

#include "render/dispatch.hpp"
#include "scene/error.hpp"
#include "scene/scene_format.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace lanecast::trade {
namespace {

constexpr int edge_samples[] = {2, 3, 4, 5, 6, 8}, grid_samples[] = {2, 3, 4, 6, 8};
constexpr int shadow_rays[] = {0, 1, 2, 4, 8, 16, 32, 64};
constexpr int depths[] = {0, 1, 2, 3, 4, 6, 8, 12, 16};
constexpr double cutoffs[] = {1.0 / 16, 1.0 / 64, 1.0 / 256, 1.0 / 1024, 1.0 / 4096};
constexpr double true_cutoff = 1.0 / 65536;
constexpr int dearest_shadow_rays = 8; ///< per sample of the pixel, each with others
constexpr int most_shadow_rays = 1024; ///< of a pixel with one sample
constexpr int steps_tried = 2;         ///< down a ladder: what one step saves may be less than the clock can tell

const KeySpec& key_of(const BlockSpec& block, std::string_view name) {
    return *std::ranges::find(block.keys, name, &KeySpec::name);
}

template <class Enum>
std::string word_of(const KeySpec& key, Enum value) {
    return std::string(key.choices[static_cast<std::size_t>(value)]);
}

KnobValue anti_aliasing(AntiAliasMode mode, int samples) {
    Choice choice;
    const auto set = [mode, samples](Choice& c) {
        c.settings.anti_aliasing.mode = mode;
        c.settings.anti_aliasing.samples = samples;
    };
    set(choice);
    return {label_of(Knob::anti_aliasing, choice), set};
}

template <class T>
KnobValue number(T RenderSettings::*member, T value) {
    return {number_text(static_cast<double>(value)), [member, value](Choice& c) { c.settings.*member = value; }};
}

KnobValue precision(Precision value) {
    return {word_of(key_of(format::render, "precision"), value), [value](Choice& c) { c.settings.precision = value; }};
}

/// Those of the format that this machine can run, the most precise last, the reference apart.
std::vector<KnobValue> precisions(std::string_view isa) {
    std::vector<KnobValue> values;
    for (std::size_t i = 0; i < key_of(format::render, "precision").choices.size(); ++i) {
        const auto value = static_cast<Precision>(i);
        if (value == Precision::reference) continue;
        try {
            static_cast<void>(find_kernels(isa, value));
            values.push_back(precision(value));
        } catch (const Error&) { // of another instruction set or build
        }
    }
    return values;
}

KnobValue file(bool floats) {
    return {floats ? "float" : "half", [floats](Choice& c) { c.float_file = floats; }};
}

/// The values, and where it is not among them the scene's own.
template <class T, std::size_t n, class Before>
std::vector<KnobValue> numbers(T RenderSettings::*member, const T (&values)[n], T own, const Before& before) {
    std::vector<T> all(std::begin(values), std::end(values));
    if (std::ranges::find(all, own) == all.end()) all.push_back(own);
    std::ranges::sort(all, before);
    std::vector<KnobValue> out;
    for (const T value : all) out.push_back(number(member, value));
    return out;
}

std::vector<KnobValue> anti_aliasings(const AntiAliasing& own) {
    // without samples: the number stays the scene's own, so that equal pictures have equal settings
    std::vector<KnobValue> values{anti_aliasing(AntiAliasMode::off, own.samples),
                                  anti_aliasing(AntiAliasMode::cross, own.samples)};
    const auto add = [&](AntiAliasMode mode, std::span<const int> samples) {
        std::vector<int> all(samples.begin(), samples.end());
        if (own.mode == mode && std::ranges::find(all, own.samples) == all.end()) all.push_back(own.samples);
        std::ranges::sort(all);
        for (const int n : all) values.push_back(anti_aliasing(mode, n));
    };
    add(AntiAliasMode::edge, edge_samples);
    add(AntiAliasMode::grid, grid_samples);
    return values;
}

Choice with(Choice choice, const KnobValue& value) {
    value.set(choice);
    return choice;
}

/// Fewer samples, by one step or two; edges only instead of everywhere; no samples instead of the fewest or the fewest but one.
std::vector<Choice> cheaper_anti_aliasing(const Choice& choice, const Ladder& ladder) {
    const AntiAliasing& aa = choice.settings.anti_aliasing;
    if (aa.mode == AntiAliasMode::off) return {};
    std::vector<Choice> fewer, out;
    for (const KnobValue& value : ladder.values) {
        const Choice next = with(choice, value);
        const AntiAliasing& other = next.settings.anti_aliasing;
        if (other.mode == aa.mode && other.samples < aa.samples) fewer.push_back(next);
        if (aa.mode == AntiAliasMode::grid && other.mode == AntiAliasMode::edge && other.samples == aa.samples)
            out.push_back(next);
    }
    out.insert(out.end(), std::ssize(fewer) > steps_tried ? fewer.end() - steps_tried : fewer.begin(), fewer.end());
    if (std::ssize(fewer) >= steps_tried) return out;
    for (const KnobValue& value : ladder.values) {
        const AntiAliasMode mode = with(choice, value).settings.anti_aliasing.mode;
        if (mode == AntiAliasMode::off || (mode == AntiAliasMode::cross && aa.mode != mode)) out.push_back(with(choice, value));
    }
    return out;
}

/// Goes up as the knob is turned up; for knobs whose value is a number, and the file.
double dearness(Knob knob, const Choice& choice) {
    switch (knob) {
    case Knob::soft_shadows:
        return choice.settings.soft_shadows;
    case Knob::depth:
        return choice.settings.depth;
    case Knob::cutoff:
        return -choice.settings.cutoff;
    case Knob::file:
        return choice.float_file ? 1 : 0;
    case Knob::precision:
    case Knob::anti_aliasing:
        break;
    }
    return 0;
}

} // namespace

const char* name_of(Knob knob) {
    constexpr const char* names[knob_count] = {"precision", "anti-aliasing", "soft shadows", "depth", "cutoff", "file"};
    return names[static_cast<int>(knob)];
}

FixedKnobs fixed_knobs(const std::function<RenderSettings(RenderSettings)>& change) {
    // Two starts that agree nowhere: where they agree afterwards, the command line decided.
    RenderSettings one, other;
    one.anti_aliasing = {AntiAliasMode::grid, 63, 1, true};
    one.soft_shadows = 1023, one.depth = 1023, one.cutoff = 0.987, one.precision = Precision::reference;
    other.anti_aliasing = {AntiAliasMode::edge, 62, 2, false};
    other.soft_shadows = 1022, other.depth = 1022, other.cutoff = 0.986, other.precision = Precision::balanced;
    one = change(one);
    other = change(other);
    FixedKnobs fixed;
    fixed[Knob::precision] = one.precision == other.precision;
    fixed[Knob::anti_aliasing] = one.anti_aliasing.mode == other.anti_aliasing.mode;
    fixed[Knob::soft_shadows] = one.soft_shadows == other.soft_shadows;
    fixed[Knob::depth] = one.depth == other.depth;
    fixed[Knob::cutoff] = one.cutoff == other.cutoff;
    return fixed;
}

std::vector<Ladder> make_ladders(const SceneArrays& scene, const Choice& base, const FixedKnobs& fixed, std::string_view isa,
                                 int truth_samples) {
    const RenderSettings& own = base.settings;
    const bool sampled = !fixed[Knob::anti_aliasing];
    std::vector<Ladder> ladders;
    const auto add = [&](Knob knob, const std::vector<KnobValue>& values, const KnobValue& truth, const KnobValue& alone) {
        if (!fixed[knob]) ladders.push_back({knob, values, truth, alone});
    };
    const KnobValue reference = precision(Precision::reference);
    add(Knob::precision, precisions(isa), reference, reference);
    const KnobValue fine = anti_aliasing(AntiAliasMode::grid, truth_samples);
    add(Knob::anti_aliasing, anti_aliasings(own.anti_aliasing), fine, fine);
    if ((scene.features & feature_soft_lights) != 0 && own.shadows) {
        const KnobValue few = number(&RenderSettings::soft_shadows, dearest_shadow_rays);
        const AntiAliasMode mode = own.anti_aliasing.mode;
        const bool one_sample = mode == AntiAliasMode::off || mode == AntiAliasMode::cross;
        const KnobValue many = number(&RenderSettings::soft_shadows, one_sample ? most_shadow_rays : most_shadow_rays / 4);
        add(Knob::soft_shadows, numbers(&RenderSettings::soft_shadows, shadow_rays, own.soft_shadows, std::less<>()),
            sampled ? few : many, many);
    }
    if ((scene.features & (feature_reflective | feature_transmissive)) != 0) {
        const int deepest = std::max(64, own.depth);
        const KnobValue deep = number(&RenderSettings::depth, deepest);
        std::vector<KnobValue> values = numbers(&RenderSettings::depth, depths, own.depth, std::less<>());
        std::erase_if(values,
                      [&](const KnobValue& v) { return with(base, v).settings.depth >= deepest && v.label != deep.label; });
        add(Knob::depth, values, deep, deep);
        const KnobValue tiny = number(&RenderSettings::cutoff, true_cutoff);
        add(Knob::cutoff, numbers(&RenderSettings::cutoff, cutoffs, own.cutoff, std::greater<>()), tiny, tiny);
    }
    add(Knob::file, {file(false), file(true)}, file(true), file(true));
    return ladders;
}

void set_true_cutoff(Ladder& ladder, double cutoff, const Choice& base) {
    std::erase_if(ladder.values, [&](const KnobValue& value) {
        const double own = with(base, value).settings.cutoff;
        return own <= cutoff && own != base.settings.cutoff;
    });
    ladder.truth = ladder.alone = number(&RenderSettings::cutoff, cutoff);
}

void set_true_depth(Ladder& ladder, int depth, const Choice& base) {
    std::erase_if(ladder.values, [&](const KnobValue& value) {
        const int own = with(base, value).settings.depth;
        return own >= depth && own != base.settings.depth;
    });
    ladder.truth = ladder.alone = number(&RenderSettings::depth, depth);
}

Choice bounded(Choice choice, const Choice& base, const Choice& truth) {
    if (choice.settings.depth > base.settings.depth)
        choice.settings.cutoff = std::max(choice.settings.cutoff, truth.settings.cutoff);
    return choice;
}

Choice true_choice(const Choice& base, const std::vector<Ladder>& ladders) {
    Choice choice = base;
    for (const Ladder& ladder : ladders) ladder.truth.set(choice);
    choice.settings.precision = Precision::reference;
    choice.float_file = true;
    return choice;
}

std::string label_of(Knob knob, const Choice& choice) {
    const RenderSettings& s = choice.settings;
    switch (knob) {
    case Knob::precision:
        return word_of(key_of(format::render, "precision"), s.precision);
    case Knob::anti_aliasing: {
        const AntiAliasMode mode = s.anti_aliasing.mode;
        const bool sampled = mode == AntiAliasMode::edge || mode == AntiAliasMode::grid;
        return word_of(key_of(format::anti_aliasing, "mode"), mode) +
               (sampled ? " " + std::to_string(s.anti_aliasing.samples) : "");
    }
    case Knob::soft_shadows:
        return number_text(s.soft_shadows);
    case Knob::depth:
        return number_text(s.depth);
    case Knob::cutoff:
        return number_text(s.cutoff);
    case Knob::file:
        return choice.float_file ? "float" : "half";
    }
    return {};
}

std::string describe(const Choice& choice, const std::vector<Ladder>& ladders) {
    std::string text;
    for (const Ladder& ladder : ladders) {
        const std::string value = label_of(ladder.knob, choice);
        const auto part = [&]() -> std::string {
            switch (ladder.knob) {
            case Knob::soft_shadows:
                return value == "0" ? "hard shadows" : value + (value == "1" ? " shadow ray" : " shadow rays");
            case Knob::depth:
                return "depth " + value;
            case Knob::cutoff:
                return "cutoff " + value;
            case Knob::anti_aliasing:
                return value == "off" ? "no anti-aliasing" : value;
            case Knob::precision:
            case Knob::file:
                return value;
            }
            return {};
        }();
        text += (text.empty() ? "" : ", ") + part;
    }
    return text;
}

Choice dearest_choice(const Choice& base, const std::vector<Ladder>& ladders) {
    Choice choice = base;
    for (const Ladder& ladder : ladders) {
        if (ladder.values.empty()) continue;
        ladder.values.back().set(choice);
        if (ladder.knob == Knob::soft_shadows)
            choice.settings.soft_shadows =
                choice.settings.anti_aliasing.mode == AntiAliasMode::grid ? dearest_shadow_rays : most_shadow_rays / 4;
        if (ladder.knob == Knob::cutoff) { // not 0, nor beyond the truth: see make_ladders
            choice.settings.cutoff = cutoffs[0];
            for (const KnobValue& value : ladder.values)
                if (with(choice, value).settings.cutoff > with(choice, ladder.truth).settings.cutoff) value.set(choice);
        }
        if (ladder.knob == Knob::precision) choice.settings.precision = Precision::balanced;
    }
    return choice;
}

std::vector<Choice> cheaper(const Choice& choice, const Ladder& ladder) {
    if (ladder.knob == Knob::anti_aliasing) return cheaper_anti_aliasing(choice, ladder);
    const std::string own = label_of(ladder.knob, choice);
    if (ladder.knob == Knob::precision) { // which one is faster is for the clock to say
        std::vector<Choice> others;
        for (const KnobValue& value : ladder.values)
            if (value.label != own) others.push_back(with(choice, value));
        return others;
    }
    std::vector<Choice> out; // of the values, which go up; that of the truth need not be among them
    for (auto value = ladder.values.rbegin(); value != ladder.values.rend() && std::ssize(out) < steps_tried; ++value)
        if (const Choice next = with(choice, *value); dearness(ladder.knob, next) < dearness(ladder.knob, choice))
            out.push_back(next);
    return out;
}

} // namespace lanecast::trade
