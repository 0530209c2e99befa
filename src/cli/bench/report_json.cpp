#include "cli/bench/report.hpp"
#include "cli/json_writer.hpp"

namespace lanecast::bench {
namespace {

void add_disagreements(JsonWriter& json, const char* key, const Disagreements& d) {
    if (d.checked == 0) return;
    json.open_object(key);
    json.add("checked", d.checked);
    json.add("missed", d.missed);
    json.add("extra", d.extra);
    json.add("other_t", d.other_t);
    json.add("at_edges", d.edges);
    json.add("upheld", d.upheld);
    json.add("ties", d.ties);
    json.close_object();
}

} // namespace

std::string json_report(const Report& report) {
    JsonWriter json;
    json.open_object();
    json.add("mesh", report.mesh);
    json.add("triangles", report.triangles);
    json.add("cpu", report.cpu);
    json.add("compiler", report.compiler);
    json.add("commit", report.commit);
    json.add("options", report.options);
    json.add("repetitions", report.repetitions);
    json.open_list("builds");
    for (const BuildRow& build : report.builds) {
        json.open_object();
        json.add("library", build.library);
        json.add("isa", build.isa);
        json.add("quality", build.quality);
        json.add("seconds", build.seconds);
        json.add("bytes", build.bytes);
        json.close_object();
    }
    json.close_list();
    json.open_list("rows");
    for (const Row& row : report.rows) {
        json.open_object();
        json.add("rays", row.rays);
        json.add("library", row.library);
        json.add("isa", row.isa);
        json.add("precision", row.precision);
        json.add("mode", row.mode);
        json.add("threads", row.threads);
        json.add("count", row.count);
        json.add("rays_per_second", row.rate.rays_per_second);
        json.add("quartile_low", row.rate.low);
        json.add("quartile_high", row.rate.high);
        if (const Row* peer = row.ours ? best_peer(report, row) : nullptr) {
            json.add("peer", peer->library + " " + peer->mode);
            json.add("ratio", row.rate.rays_per_second / peer->rate.rays_per_second);
        }
        add_disagreements(json, "against_reference", row.reference);
        add_disagreements(json, "against_peer", row.peer);
        json.close_object();
    }
    json.close_list();
    json.close_object();
    return json.finished();
}

} // namespace lanecast::bench
