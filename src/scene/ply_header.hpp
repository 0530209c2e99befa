#pragma once
// The header of a PLY file (Turk 1994): text that lists elements and their properties, before a body in text or binary.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };

[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
    std::string_view name;
    PlyType type = PlyType::float32; ///< of the value, or of a list's items
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< of a list's length
};

struct PlyElement {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t offset = 0; ///< of its line, for messages
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements; ///< in the order of the body
    std::size_t body = 0;             ///< byte offset
};

/// Views into `bytes`. Throws Error(asset) with line and column. Each count has been checked against the bytes that follow.
[[nodiscard]] PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

} // namespace lanecast
