#include "scene/ply_header.hpp"

#include "scene/diagnostic.hpp"
#include "scene/error.hpp"
#include "scene/mesh_file.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace lanecast {
namespace {

constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},     {"int8", PlyType::int8},       {"uchar", PlyType::uint8},    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},   {"int16", PlyType::int16},     {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},
    {"int", PlyType::int32},     {"int32", PlyType::int32},     {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
    {"float", PlyType::float32}, {"float32", PlyType::float32}, {"double", PlyType::float64}, {"float64", PlyType::float64}};

class HeaderReader {
public:
    HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    PlyHeader run() {
        if (!next_line() || word() != "ply") fail(0, "a PLY file starts with the line `ply`");
        bool has_format = false;
        while (next_line()) {
            const std::string_view keyword = word();
            if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
            if (keyword == "format")
                read_format(), has_format = true;
            else if (keyword == "element")
                read_element();
            else if (keyword == "property")
                read_property();
            else if (keyword == "end_header") {
                if (!has_format) fail(line_, "the header lacks its `format` line");
                header_.body = next_;
                return std::move(header_);
            } else
                fail(word_, "unknown header line `" + printable(keyword) + "`");
        }
        fail(bytes_.size(), "the header does not end: `end_header` is missing");
    }

    [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
        throw Error(ExitCode::asset, format_diagnostic(name_, bytes_, offset, "error", message));
    }

private:
    bool next_line() {
        if (next_ >= bytes_.size()) return false;
        line_ = at_ = next_;
        const std::size_t line_break = bytes_.find('\n', next_);
        next_ = line_break == std::string_view::npos ? bytes_.size() : line_break + 1;
        end_ = line_break == std::string_view::npos ? bytes_.size() : line_break;
        if (end_ > line_ && bytes_[end_ - 1] == '\r') --end_;
        return true;
    }

    std::string_view word() {
        const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
        while (at_ < end_ && is_blank(bytes_[at_])) ++at_;
        word_ = at_;
        while (at_ < end_ && !is_blank(bytes_[at_])) ++at_;
        return bytes_.substr(word_, at_ - word_);
    }

    void read_format() {
        const std::string_view format = word();
        if (format == "ascii")
            header_.format = PlyFormat::ascii;
        else if (format == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (format == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else
            fail(word_, "must be `ascii`, `binary_little_endian` or `binary_big_endian`, got `" + printable(format) + "`");
        if (const std::string_view version = word(); version != "1.0")
            fail(word_, "must be version 1.0, got `" + printable(version) + "`");
    }

    void read_element() {
        PlyElement element;
        element.offset = line_;
        element.name = word();
        const std::string_view count = word();
        const auto parsed = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (count.empty() || parsed.ec != std::errc() || parsed.ptr != count.data() + count.size())
            fail(word_, "must be the number of elements, got `" + printable(count) + "`");
        header_.elements.push_back(std::move(element));
    }

    PlyType read_type() {
        const std::string_view type = word();
        for (const auto& [name, value] : type_names)
            if (name == type) return value;
        fail(word_, "must be a PLY type (char uchar short ushort int uint float double), got `" + printable(type) + "`");
    }

    void read_property() {
        if (header_.elements.empty()) fail(line_, "a property before any element");
        PlyProperty property;
        const std::size_t first = at_;
        property.is_list = word() == "list";
        if (!property.is_list) at_ = first;
        if (property.is_list) {
            property.count_type = read_type();
            if (property.count_type >= PlyType::float32) fail(word_, "the length of a list must be of an integer type");
        }
        property.type = read_type();
        property.name = word();
        if (property.name.empty()) fail(end_, "the property lacks a name");
        header_.elements.back().properties.push_back(property);
    }

    std::string_view bytes_;
    const std::string& name_;
    PlyHeader header_;
    std::size_t line_ = 0, next_ = 0, at_ = 0, end_ = 0, word_ = 0;
};

/// Fewest bytes an item can take. In text, a value and its separator.
std::size_t least_size(const PlyElement& element, PlyFormat format) {
    std::size_t out = 0;
    for (const PlyProperty& property : element.properties)
        out += format == PlyFormat::ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
    return out;
}

} // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
    HeaderReader reader(bytes, name);
    PlyHeader header = reader.run();
    // The last value of a text needs no separator.
    std::size_t left = bytes.size() - header.body + (header.format == PlyFormat::ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        if (element.count == 0) continue;
        if (element.properties.empty()) reader.fail(element.offset, "the element has no properties");
        const std::size_t least = least_size(element, header.format);
        if (element.count > left / least)
            reader.fail(element.offset, "the file is too short for " + std::to_string(element.count) + " elements of `" +
                                            printable(element.name) + "`: " + std::to_string(bytes.size() - header.body) +
                                            " bytes follow the header");
        left -= static_cast<std::size_t>(element.count) * least;
        if (element.count > max_mesh_elements)
            throw Error(ExitCode::memory, format_diagnostic(name, bytes, element.offset, "error",
                                                            "more than " + std::to_string(max_mesh_elements) + " elements"));
    }
    return header;
}

} // namespace lanecast
