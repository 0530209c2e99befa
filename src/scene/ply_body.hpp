#pragma once
// The values of a PLY file's body, one after the other, whatever the format. Every number of a PLY file fits a double exactly.

#include "scene/diagnostic.hpp"
#include "scene/error.hpp"
#include "scene/ply_header.hpp"
#include "scene/read_number.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace lanecast {

static_assert(std::endian::native == std::endian::little);

template <class T>
[[nodiscard]] inline T load(const char* at, bool swap) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, at, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

[[nodiscard]] inline double load(const char* at, PlyType type, bool swap) {
    switch (type) {
    case PlyType::int8:
        return static_cast<signed char>(*at);
    case PlyType::uint8:
        return static_cast<unsigned char>(*at);
    case PlyType::int16:
        return load<std::int16_t>(at, swap);
    case PlyType::uint16:
        return load<std::uint16_t>(at, swap);
    case PlyType::int32:
        return load<std::int32_t>(at, swap);
    case PlyType::uint32:
        return load<std::uint32_t>(at, swap);
    case PlyType::float32:
        return static_cast<double>(load<float>(at, swap));
    case PlyType::float64:
        return load<double>(at, swap);
    }
    return 0;
}

class BinaryBody {
public:
    BinaryBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
        : bytes_(bytes), at_(header.body), swap_(header.format == PlyFormat::big_endian), name_(name) {}

    double next(PlyType type) {
        require(size_of(type));
        start_ = at_;
        at_ += size_of(type);
        return load(bytes_.data() + start_, type, swap_);
    }
    void skip(PlyType type, std::size_t count) {
        if (count > (bytes_.size() - at_) / size_of(type)) require(bytes_.size());
        at_ += count * size_of(type);
    }
    /// Whether `count` values of a type can follow.
    [[nodiscard]] bool has_room(PlyType type, std::size_t count) const { return count <= (bytes_.size() - at_) / size_of(type); }
    /// `count` bytes that can be read without further checks; null where the file is shorter.
    [[nodiscard]] const char* bytes(std::size_t count) const {
        return count <= bytes_.size() - at_ ? bytes_.data() + at_ : nullptr;
    }
    void advance(std::size_t count) { at_ += count; }
    [[nodiscard]] bool swapped() const { return swap_; }
    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ExitCode::asset, name_ + ": error: at byte " + std::to_string(start_) + ": " + message);
    }

private:
    void require(std::size_t size) {
        if (size <= bytes_.size() - at_) return;
        start_ = bytes_.size();
        fail("the file ends too early");
    }

    std::string_view bytes_;
    std::size_t at_, start_ = 0;
    bool swap_;
    const std::string& name_;
};

class TextBody {
public:
    TextBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
        : bytes_(bytes), at_(bytes.data() + header.body), start_(at_), end_(bytes.data() + bytes.size()), name_(name) {}

    double next(PlyType) {
        while (at_ != end_ && is_space(*at_)) ++at_;
        start_ = at_;
        double value = 0;
        if (at_ == end_) fail("the file ends too early");
        if (!read_number(at_, end_, value) || (at_ != end_ && !is_space(*at_))) {
            while (at_ != end_ && !is_space(*at_)) ++at_;
            fail("must be a number, got `" + printable({start_, static_cast<std::size_t>(at_ - start_)}, 40) + "`");
        }
        return value;
    }
    void skip(PlyType type, std::size_t count) {
        for (; count > 0; --count) next(type);
    }
    [[nodiscard]] bool has_room(PlyType, std::size_t count) const { return count <= static_cast<std::size_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ExitCode::asset,
                    format_diagnostic(name_, bytes_, static_cast<std::size_t>(start_ - bytes_.data()), "error", message));
    }

private:
    static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

    std::string_view bytes_;
    const char *at_, *start_, *end_;
    const std::string& name_;
};

} // namespace lanecast
