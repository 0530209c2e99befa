#include "cli/json_writer.hpp"
#include "cli/measure/report.hpp"
#include "cli/settings_options.hpp"

namespace lanecast::trade {
namespace {

void add_error(JsonWriter& json, const char* key, const PictureError& error) {
    json.open_object(key);
    json.add("rmse", error.rmse);
    json.add("relmse", error.relmse);
    json.add("largest", error.largest);
    json.add("off_share", error.off);
    json.add("flip", error.flip);
    json.close_object();
}

void add_choice(JsonWriter& json, const Report& report, const Choice& choice) {
    json.add("choice", describe(choice, report.ladders));
    json.add("settings", settings_json(choice.settings));
    json.add("float_file", choice.float_file);
}

template <class T>
void add_list(JsonWriter& json, const char* key, const std::vector<T>& values) {
    json.add_numbers(key, std::span<const T>(values));
}

void add_rays(JsonWriter& json, const RayErrors& r) {
    json.open_object();
    json.add("precision", r.precision);
    json.add("isa", r.isa);
    json.add("rays", name_of(r.rays));
    json.add("count", r.count);
    json.add("missed", r.missed);
    json.add("false", r.false_hits);
    if (r.rays != RayClass::shadow) {
        json.add("wrong_object", r.wrong_object);
        json.add("compared", r.compared);
        json.add_numbers("t_ulp_p50_p99_max", std::span<const double>(std::vector{r.ulp_p50, r.ulp_p99, r.ulp_max}));
        json.add_numbers("normal_angle_p50_p99_max", std::span<const double>(std::vector{r.angle_p50, r.angle_p99, r.angle_max}));
    }
    json.close_object();
}

} // namespace

std::string json_report(const Report& report) {
    JsonWriter json;
    json.open_object();
    json.add("scene", report.scene);
    json.add("width", report.width);
    json.add("height", report.height);
    json.add("cpu", report.cpu);
    json.add("compiler", report.compiler);
    json.add("version", LANECAST_VERSION);
    json.add("threads", report.threads);
    json.add("repetitions", report.repetitions);
    json.add("tiles", report.tiles);
    json.add("tile_size", report.tile_size);
    json.add("whole_frame", report.whole);
    json.add("share_of_pixels", report.share);
    json.open_object("reference");
    add_choice(json, report, report.truth);
    json.add("seconds", report.truth_seconds);
    json.add("second_choice", report.second_choice);
    add_error(json, "second_error", report.second);
    json.close_object();
    json.open_list("trials");
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        const Trial& trial = report.trials[i];
        json.open_object();
        add_choice(json, report, trial.choice);
        json.add("seconds", trial.seconds);
        json.add("seconds_low", trial.low);
        json.add("seconds_high", trial.high);
        json.add("file_seconds", trial.file_seconds);
        json.add("rays", trial.rays);
        json.add("on_front", is_on_front(report, i));
        add_error(json, "error", trial.error);
        json.close_object();
    }
    json.close_list();
    json.open_list("knobs");
    for (const KnobRow& row : report.knobs) {
        json.open_object();
        json.add("knob", name_of(row.knob));
        json.add("value", row.value);
        json.add("given", row.given);
        json.add("trial", row.trial);
        add_error(json, "own_error", row.own);
        json.close_object();
    }
    json.close_list();
    add_list(json, "walk", report.walk);
    add_list(json, "front", report.front);
    json.open_list("on_no_front");
    for (const Ladder& ladder : report.ladders)
        for (const std::string& value : unused_values(report, ladder)) {
            json.open_object();
            json.add("knob", name_of(ladder.knob));
            json.add("value", value);
            json.close_object();
        }
    json.close_list();
    json.open_list("rays");
    for (const RayErrors& row : report.rays) add_rays(json, row);
    json.close_list();
    json.close_object();
    return json.finished();
}

} // namespace lanecast::trade
