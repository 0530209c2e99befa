#pragma once
// What trades accuracy for time: the knobs, their values from cheap to dear, and the value that counts as the truth.

#include "scene/render_settings.hpp"
#include "scene/scene_arrays.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast::trade {

/// Everything a user may choose: the settings, and how the file holds them.
struct Choice {
    RenderSettings settings;
    bool float_file = false;
};

enum class Knob { precision, anti_aliasing, soft_shadows, depth, cutoff, file };
inline constexpr int knob_count = 6;
[[nodiscard]] const char* name_of(Knob knob);

/// Knobs that the user has set by hand are part of what is wanted and are not turned.
struct FixedKnobs {
    bool fixed[knob_count] = {};
    [[nodiscard]] bool operator[](Knob knob) const { return fixed[static_cast<int>(knob)]; }
    [[nodiscard]] bool& operator[](Knob knob) { return fixed[static_cast<int>(knob)]; }
};

/// `change`: applies what the command line says to settings.
[[nodiscard]] FixedKnobs fixed_knobs(const std::function<RenderSettings(RenderSettings)>& change);

struct KnobValue {
    std::string label;
    std::function<void(Choice&)> set;
};

struct Ladder {
    Knob knob;
    std::vector<KnobValue> values; ///< cheap to dear; precision: as the format has them; anti-aliasing: by mode, in it by samples
    KnobValue truth;
    KnobValue alone; ///< the truth where the other knobs are not at theirs: shadow rays then have no samples to share the work
};

/// Knobs that can change this scene's picture and are not fixed; `base`: its settings, whose own values are among them. Presets
/// of precision are those of the scene format that this build and CPU have at `isa`.
[[nodiscard]] std::vector<Ladder> make_ladders(const SceneArrays& scene, const Choice& base, const FixedKnobs& fixed,
                                               std::string_view isa, int truth_samples);

/// Another cutoff as the truth: smaller ones, but for the scene's own, leave the ladder.
void set_true_cutoff(Ladder& ladder, double cutoff, const Choice& base);
/// The same of the depth: larger ones leave.
void set_true_depth(Ladder& ladder, int depth, const Choice& base);

/// All knobs at their truth.
[[nodiscard]] Choice true_choice(const Choice& base, const std::vector<Ladder>& ladders);

/// Deeper than the scene asks for, but with a cutoff of at least the truth's: else mirrors in glass are without end.
[[nodiscard]] Choice bounded(Choice choice, const Choice& base, const Choice& truth);

/// The value of a choice, as the ladders label them.
[[nodiscard]] std::string label_of(Knob knob, const Choice& choice);

/// "balanced, grid 4, 16 shadow rays, depth 8": what the ladders have.
[[nodiscard]] std::string describe(const Choice& choice, const std::vector<Ladder>& ladders);

/// The best values that are worth trying, none of them the truth's.
[[nodiscard]] Choice dearest_choice(const Choice& base, const std::vector<Ladder>& ladders);

/// Choices that may be cheaper by a step or two of this knob.
[[nodiscard]] std::vector<Choice> cheaper(const Choice& choice, const Ladder& ladder);

} // namespace lanecast::trade
