#include "cli/settings_options.hpp"

#include "cli/number_option.hpp"
#include "scene/scene_format.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <span>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

constexpr const char* group = "Switches (they win over the scene's `render` block)";

struct Switch {
    const char* key;
    const char* option;
    const char* help;
    bool& (*member)(RenderSettings&);
};

constexpr Switch switches[] = {
    {"ambient", "ambient", "Ambient light", [](RenderSettings& s) -> bool& { return s.ambient; }},
    {"diffuse", "diffuse", "Diffuse light", [](RenderSettings& s) -> bool& { return s.diffuse; }},
    {"specular", "specular", "Specular highlights", [](RenderSettings& s) -> bool& { return s.specular; }},
    {"shadows", "shadows", "Shadows", [](RenderSettings& s) -> bool& { return s.shadows; }},
    {"transmissive_shadows", "transmissive-shadows", "Transmissive surfaces tint the light instead of blocking it",
     [](RenderSettings& s) -> bool& { return s.transmissive_shadows; }},
    {"reflections", "reflections", "Mirror rays", [](RenderSettings& s) -> bool& { return s.reflections; }},
    {"transmission", "transmission", "Transmitted rays; off: everything is opaque",
     [](RenderSettings& s) -> bool& { return s.transmission; }},
    {"refraction", "refraction", "Bending of transmitted rays; off: straight through",
     [](RenderSettings& s) -> bool& { return s.refraction; }},
    {"schlick", "schlick", "Schlick's Fresnel term on reflections", [](RenderSettings& s) -> bool& { return s.schlick; }},
    {"planes", "planes", "Infinite planes", [](RenderSettings& s) -> bool& { return s.planes; }},
};

const KeySpec& key_of(const BlockSpec& block, std::string_view name) {
    return *std::ranges::find(block.keys, name, &KeySpec::name);
}

void add_switch(CLI::App& command, SettingsChanges& changes, const std::string& name, const std::string& help,
                bool& (*member)(RenderSettings&)) {
    CLI::Option* const option = command.add_flag("--" + name + ",!--no-" + name, help);
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)->group(group);
    changes.push_back([option, member](RenderSettings& settings) {
        if (option->count() > 0) member(settings) = option->as<bool>();
    });
}

template <class Set>
void add_number(CLI::App& command, SettingsChanges& changes, const std::string& name, const char* help, const KeySpec& key,
                const Set& set) {
    const auto add = [&changes, set](double value) {
        changes.push_back([value, set](RenderSettings& settings) { set(settings, value); });
    };
    add_number_option(command, name, help, key, add)->group(group)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

template <class Enum>
void add_choice(CLI::App& command, SettingsChanges& changes, const std::string& name, const char* help, const KeySpec& key,
                Enum& (*member)(RenderSettings&)) {
    std::string words;
    for (const std::string_view word : key.choices) words.append(words.empty() ? "" : "|").append(word);
    const auto parsed = [&changes, name, &key, member](const std::string& text) {
        const auto found = std::ranges::find(key.choices, text);
        if (found == key.choices.end()) throw CLI::ValidationError(name, "must be " + describe(key) + ", got '" + text + "'");
        changes.push_back([value = static_cast<Enum>(found - key.choices.begin()), member](RenderSettings& settings) {
            member(settings) = value;
        });
    };
    command.add_option_function<std::string>(name, parsed, help)
        ->type_name(words)
        ->group(group)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

/// A switch that may also be given a word. See `join_bvh_words`.
void add_bvh(CLI::App& command, SettingsChanges& changes, const KeySpec& key) {
    std::vector<std::string> words{"false", "true"};
    words.insert(words.end(), key.choices.begin(), key.choices.end());
    const std::string help = "The tree: off (every ray tests every primitive), default or quality; same picture";
    CLI::Option* const option = command.add_flag("--bvh,!--no-bvh", help);
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)->group(group)->check(CLI::IsMember(words));
    changes.push_back([option, &key](RenderSettings& settings) {
        if (option->count() == 0) return;
        const std::string word = option->results().back();
        const auto found = std::ranges::find(key.choices, word);
        settings.bvh = found != key.choices.end() ? static_cast<BvhMode>(found - key.choices.begin())
                       : word == "false"          ? BvhMode::off
                                                  : BvhMode::standard;
    });
}

const char* json_bool(bool value) { return value ? "true" : "false"; }

} // namespace

void add_settings_options(CLI::App& command, SettingsChanges& changes) {
    for (const Switch& s : switches) add_switch(command, changes, s.option, s.help, s.member);
    const BlockSpec &render = format::render, &aa = format::anti_aliasing;
    add_bvh(command, changes, key_of(render, "bvh"));
    add_number(command, changes, "--depth",
               "Last level of reflected and transmitted rays that is traced; the camera ray is level 0", key_of(render, "depth"),
               [](RenderSettings& s, double v) { s.depth = static_cast<int>(v); });
    add_number(command, changes, "--cutoff", "Rays that contribute less than this are not traced", key_of(render, "cutoff"),
               [](RenderSettings& s, double v) { s.cutoff = v; });
    add_number(command, changes, "--soft-shadows", "Shadow rays per light with a radius or an angle; 0: hard shadows",
               key_of(render, "soft_shadows"), [](RenderSettings& s, double v) { s.soft_shadows = static_cast<int>(v); });
    add_choice<AntiAliasMode>(command, changes, "--anti-aliasing,--aa", "Anti-aliasing", key_of(aa, "mode"),
                              [](RenderSettings& s) -> AntiAliasMode& { return s.anti_aliasing.mode; });
    add_number(command, changes, "--aa-samples", "Samples per side of a pixel, of grid and edge", key_of(aa, "samples"),
               [](RenderSettings& s, double v) { s.anti_aliasing.samples = static_cast<int>(v); });
    add_number(command, changes, "--aa-offset", "Offset of the cross's rays in pixels", key_of(aa, "offset"),
               [](RenderSettings& s, double v) { s.anti_aliasing.offset = v; });
    add_switch(command, changes, "aa-planes", "The cross also on planes",
               [](RenderSettings& s) -> bool& { return s.anti_aliasing.planes; });
    add_choice<Precision>(command, changes, "--precision", "How numbers are computed", key_of(render, "precision"),
                          [](RenderSettings& s) -> Precision& { return s.precision; });
}

std::vector<std::string> join_bvh_words(int argc, const char* const* argv) {
    std::vector<std::string> arguments(argv, argv + argc);
    const std::span<const std::string_view> words = key_of(format::render, "bvh").choices;
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
        if (arguments[i] == "--") break;
        if (arguments[i] != "--bvh" || std::ranges::find(words, arguments[i + 1]) == words.end()) continue;
        arguments[i] += "=" + arguments[i + 1];
        arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    return arguments;
}

RenderSettings changed(RenderSettings settings, const SettingsChanges& changes) {
    for (const auto& change : changes) change(settings);
    return settings;
}

std::string settings_json(const RenderSettings& settings) {
    RenderSettings s = settings;
    std::string json = "{";
    for (const Switch& one : switches) json += std::string("\"") + one.key + "\": " + json_bool(one.member(s)) + ", ";
    const auto word = [](const KeySpec& key, auto value) { return std::string(key.choices[static_cast<std::size_t>(value)]); };
    json += "\"bvh\": \"" + word(key_of(format::render, "bvh"), s.bvh) + "\", ";
    json += "\"anti_aliasing\": {\"mode\": \"" + word(key_of(format::anti_aliasing, "mode"), s.anti_aliasing.mode) +
            "\", \"samples\": " + std::to_string(s.anti_aliasing.samples) +
            ", \"offset\": " + number_text(s.anti_aliasing.offset) + ", \"planes\": " + json_bool(s.anti_aliasing.planes) + "}, ";
    json += "\"soft_shadows\": " + std::to_string(s.soft_shadows) + ", \"depth\": " + std::to_string(s.depth) +
            ", \"cutoff\": " + number_text(s.cutoff) + ", \"precision\": \"" +
            word(key_of(format::render, "precision"), s.precision) + "\"}";
    return json;
}

} // namespace lanecast
