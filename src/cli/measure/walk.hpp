#pragma once
// From the dearest settings downhill: in each step the knob is turned that saves the most time for the error it adds.

#include "cli/measure/trial.hpp"

#include <functional>
#include <map>

namespace lanecast::trade {

struct Step {
    Choice choice;
    PictureError error;
    double seconds = 0; ///< processor time of a whole frame
};

/// Trials on a spread of tiles; each choice is tried once.
class Laboratory {
public:
    Laboratory(Bench bench, ReferencePicture reference) : bench_(std::move(bench)), reference_(std::move(reference)) {}

    [[nodiscard]] const Step& tried(const Choice& choice);
    [[nodiscard]] const ReferencePicture& reference() const { return reference_; }
    [[nodiscard]] const Bench& bench() const { return bench_; }
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const auto& [name, step] : steps_) visit(step);
    }
    [[nodiscard]] std::size_t trials() const { return steps_.size(); }

private:
    Bench bench_;
    ReferencePicture reference_;
    std::map<std::string, Step> steps_; ///< by the choice as text
};

/// What is kept small, as it adds up: the square of an RMSE.
using Badness = std::function<double(const PictureError&)>;
using Accept = std::function<bool(const Step&)>;

/// The steps from `from` on, itself first; each is accepted. Ends where no step is, or where nothing gets cheaper.
[[nodiscard]] std::vector<Step> walk(Laboratory& laboratory, const std::vector<Ladder>& ladders, const Choice& from,
                                     const Badness& badness, const Accept& accept);

/// Indices of those that no other one beats in both, fastest first.
[[nodiscard]] std::vector<std::size_t> front_of(const std::vector<double>& seconds, const std::vector<double>& errors);

} // namespace lanecast::trade
