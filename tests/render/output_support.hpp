#pragma once
// For the tests of what leaves the program as a file.

#include "render/film.hpp"
#include "scene/error.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <stdlib.h>

namespace lanecast::test {

/// A new empty directory that goes with all in it.
struct TemporaryDirectory {
    std::filesystem::path path;
    TemporaryDirectory() {
        std::string name = (std::filesystem::temp_directory_path() / "lanecast_test_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
        path = name;
    }
    ~TemporaryDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
};

inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void put(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

inline std::vector<std::string> names_in(const std::filesystem::path& directory) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) names.push_back(entry.path().filename().string());
    return names;
}

/// Any finite float: every bit pattern but NaN and the infinities.
template <class Random>
float random_finite(Random& random) {
    for (;;) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (value - value == 0.0f) return value;
    }
}

template <class Value>
Film film_of(int image_width, int image_height, const Tile& crop, const Value& value) {
    Film film = make_film(image_width, image_height, crop);
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x)
            for (int c = 0; c < 3; ++c)
                film.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>(y * film.width + x)] =
                    value(film.x0 + x, film.y0 + y, c);
    return film;
}

inline bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

/// The Error that `action` throws; its message is empty if it throws none.
template <class Action>
Error error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return {ExitCode::done, ""};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace lanecast::test
