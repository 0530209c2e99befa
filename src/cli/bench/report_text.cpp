#include "cli/bench/report.hpp"

#include "cli/print.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace lanecast::bench {
namespace {

std::string padded(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}
std::string filled(const std::string& text, std::size_t width) {
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

std::string spread(const Rate& rate) {
    return fixed(100 * (rate.high - rate.low) / (2 * std::max(rate.rays_per_second, 1.0)), 0) + "%";
}

/// "13-11 of 65536": rays that disagree, less those at edges.
std::string disagreements(const Disagreements& d) {
    return std::to_string(d.count()) + " - " + std::to_string(d.edges) + " / " + std::to_string(d.checked);
}

void add_row(const Report& report, const Row& row, std::string& text) {
    text += filled(row.rays, 10) + filled(row.isa, 8) + filled(row.precision, 11) + filled(row.mode, 8) +
            padded(std::to_string(row.threads), 3) + padded(short_count(static_cast<double>(row.count)), 9) +
            padded(fixed(row.rate.rays_per_second * 1e-6, 2), 9) + padded("+-" + spread(row.rate), 7);
    if (const Row* peer = best_peer(report, row))
        text += padded(fixed(peer->rate.rays_per_second * 1e-6, 2), 9) + padded("+-" + spread(peer->rate), 7) + "  " +
                filled(peer->mode, 11) + padded(fixed(row.rate.rays_per_second / peer->rate.rays_per_second, 2), 6);
    if (row.reference.checked > 0) text += "   " + disagreements(row.reference);
    if (row.peer.checked > 0) text += "; " + disagreements(row.peer) + ", " + std::to_string(row.peer.upheld);
    text += "\n";
}

} // namespace

const Row* best_peer(const Report& report, const Row& row) {
    const Row* best = nullptr;
    for (const Row& peer : report.rows) {
        if (peer.ours || peer.rays != row.rays || peer.isa != row.isa || peer.threads != row.threads) continue;
        if (best == nullptr || peer.rate.rays_per_second > best->rate.rays_per_second) best = &peer;
    }
    return best;
}

std::string text_report(const Report& report) {
    std::string text = report.mesh + ", " + short_count(static_cast<double>(report.triangles)) + " triangles; " + report.cpu +
                       "; " + report.compiler + "; " + report.commit + "; median of " + std::to_string(report.repetitions) +
                       " per chunk of 1024 rays\n\n";
    text += filled("build", 18) + filled("isa", 8) + filled("quality", 9) + padded("seconds", 9) + padded("Mtri/s", 9) +
            padded("B/tri", 8) + "\n";
    for (const BuildRow& build : report.builds) {
        const auto triangles = static_cast<double>(report.triangles);
        text += filled(build.library, 18) + filled(build.isa, 8) + filled(build.quality, 9) + padded(fixed(build.seconds, 3), 9) +
                padded(fixed(triangles / build.seconds * 1e-6, 2), 9) + padded(fixed(build.bytes / triangles, 1), 8) + "\n";
    }
    const auto peer = std::find_if(report.rows.begin(), report.rows.end(), [](const Row& row) { return !row.ours; });
    text += "\n" + filled("rays", 10) + filled("isa", 8) + filled("precision", 11) + filled("tree", 8) + "thr" +
            padded("count", 9) + padded("Mray/s", 9) + padded("", 7);
    if (peer != report.rows.end()) text += padded("peer", 9) + padded("", 7) + "  " + filled("its mode", 11) + padded("ratio", 6);
    text += "   disagreements\n";
    for (const Row& row : report.rows)
        if (row.ours) add_row(report, row, text);
    text += "\ndisagreements: rays whose hit differs from that of the double-precision reference - those of them that move to "
            "the other "
            "answer within the rounding of the ray (edges) / checked";
    if (peer != report.rows.end())
        text += "; the same against the peer, and in how many of the rest the reference is on our side\npeer: " + peer->library +
                ", the best of its modes on these rays; its rays are converted beforehand, ours within the time";
    text += "\n";
    return text;
}

} // namespace lanecast::bench
