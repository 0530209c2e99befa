#include "cli/selftest/state.hpp"

#include "render/output_file.hpp"
#include "scene/error.hpp"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace lanecast::selftest {
namespace {

constexpr const char* title = "lanecast selftest state 1";

std::string hexadecimal(double value) { // exactly as it was
    char text[64];
    std::snprintf(text, sizeof text, "%a", value);
    return text;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw Error(ExitCode::usage, file.string() + ": " + why);
}

Tally read_tally(const std::string& numbers, const std::string& errors, const std::string& example, bool& good) {
    Tally tally;
    std::istringstream in(numbers);
    std::string worst;
    good = static_cast<bool>(in >> tally.rays >> tally.failures >> worst);
    tally.worst = std::strtod(worst.c_str(), nullptr); // streams do not read "0x1p+1" nor "inf"
    std::istringstream list(errors);
    int place = 0;
    std::uint64_t count = 0;
    while (list >> place >> count) tally.errors[place] = count;
    tally.example = example;
    return tally;
}

} // namespace

void write_state(const std::filesystem::path& file, const std::string& run, const std::vector<Progress>& all) {
    std::ostringstream out;
    out << title << "\n" << run << "\n";
    for (const Progress& p : all) {
        if (p.blocks == 0) continue;
        out << name_of(*p.c) << "\n" << p.blocks << " " << hexadecimal(p.seconds) << "\n";
        out << p.tally.rays << " " << p.tally.failures << " " << hexadecimal(p.tally.worst) << "\n";
        for (const auto& [place, count] : p.tally.errors) out << place << " " << count << " ";
        out << "\n" << p.tally.example << "\n";
    }
    write_file(file, out.str());
}

void read_state(const std::filesystem::path& file, const std::string& run, std::vector<Progress>& all) {
    if (!std::filesystem::exists(file)) return;
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line) || line != title) refuse(file, "is not a state of `lanecast selftest`");
    if (!std::getline(in, line) || line != run) refuse(file, "is of another run: " + line + "; this one is: " + run);
    std::string name, progress, numbers, errors, example;
    while (std::getline(in, name)) {
        if (!std::getline(in, progress) || !std::getline(in, numbers) || !std::getline(in, errors) || !std::getline(in, example))
            refuse(file, "ends early");
        for (Progress& p : all) {
            if (name_of(*p.c) != name) continue;
            bool good = false;
            p.tally = read_tally(numbers, errors, example, good);
            char* end = nullptr;
            p.blocks = std::strtoull(progress.c_str(), &end, 10);
            p.seconds = std::strtod(end, nullptr);
            if (!good || p.blocks == 0 || p.blocks > p.planned) refuse(file, "cannot be read: " + name);
        }
    }
}

} // namespace lanecast::selftest
