#include "cli/bench/drawing.hpp"

#include "cli/print.hpp"
#include "render/output_file.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace lanecast::bench {
namespace {

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return safe;
}

/// Five columns of seven pixels, the top one in the lowest bit.
struct Glyph {
    char character;
    std::uint8_t columns[5];
};
constexpr Glyph glyphs[] = {
    {'A', {0x7e, 0x09, 0x09, 0x09, 0x7e}}, {'B', {0x7f, 0x49, 0x49, 0x49, 0x36}}, {'C', {0x3e, 0x41, 0x41, 0x41, 0x22}},
    {'D', {0x7f, 0x41, 0x41, 0x41, 0x3e}}, {'E', {0x7f, 0x49, 0x49, 0x49, 0x41}}, {'F', {0x7f, 0x09, 0x09, 0x09, 0x01}},
    {'G', {0x3e, 0x41, 0x49, 0x49, 0x3a}}, {'H', {0x7f, 0x08, 0x08, 0x08, 0x7f}}, {'I', {0x00, 0x41, 0x7f, 0x41, 0x00}},
    {'J', {0x20, 0x40, 0x40, 0x40, 0x3f}}, {'K', {0x7f, 0x08, 0x14, 0x22, 0x41}}, {'L', {0x7f, 0x40, 0x40, 0x40, 0x40}},
    {'M', {0x7f, 0x02, 0x0c, 0x02, 0x7f}}, {'N', {0x7f, 0x04, 0x08, 0x10, 0x7f}}, {'O', {0x3e, 0x41, 0x41, 0x41, 0x3e}},
    {'P', {0x7f, 0x09, 0x09, 0x09, 0x06}}, {'Q', {0x3e, 0x41, 0x51, 0x21, 0x5e}}, {'R', {0x7f, 0x09, 0x19, 0x29, 0x46}},
    {'S', {0x26, 0x49, 0x49, 0x49, 0x32}}, {'T', {0x01, 0x01, 0x7f, 0x01, 0x01}}, {'U', {0x3f, 0x40, 0x40, 0x40, 0x3f}},
    {'V', {0x1f, 0x20, 0x40, 0x20, 0x1f}}, {'W', {0x3f, 0x40, 0x38, 0x40, 0x3f}}, {'X', {0x63, 0x14, 0x08, 0x14, 0x63}},
    {'Y', {0x07, 0x08, 0x70, 0x08, 0x07}}, {'Z', {0x61, 0x51, 0x49, 0x45, 0x43}}, {'0', {0x3e, 0x51, 0x49, 0x45, 0x3e}},
    {'1', {0x00, 0x42, 0x7f, 0x40, 0x00}}, {'2', {0x62, 0x51, 0x49, 0x49, 0x46}}, {'3', {0x22, 0x41, 0x49, 0x49, 0x36}},
    {'4', {0x18, 0x14, 0x12, 0x7f, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}}, {'6', {0x3c, 0x4a, 0x49, 0x49, 0x30}},
    {'7', {0x01, 0x71, 0x09, 0x05, 0x03}}, {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1e}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {',', {0x00, 0x50, 0x30, 0x00, 0x00}}, {':', {0x00, 0x36, 0x36, 0x00, 0x00}},
    {'+', {0x08, 0x08, 0x3e, 0x08, 0x08}}, {'-', {0x08, 0x08, 0x08, 0x08, 0x08}}, {'/', {0x20, 0x10, 0x08, 0x04, 0x02}},
    {'(', {0x00, 0x1c, 0x22, 0x41, 0x00}}, {')', {0x00, 0x41, 0x22, 0x1c, 0x00}}, {'_', {0x40, 0x40, 0x40, 0x40, 0x40}}};
constexpr int advance = 6;

const Glyph* glyph_of(char c) {
    const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    const auto* const found =
        std::find_if(std::begin(glyphs), std::end(glyphs), [&](const Glyph& glyph) { return glyph.character == capital; });
    return found == std::end(glyphs) ? nullptr : found;
}

/// Pixels x0 <= x < x1, clipped.
void fill(Picture8& picture, double x0, double y0, double x1, double y1, std::uint32_t rgb) {
    const auto pixel = [](double v, int end) { return std::clamp(static_cast<int>(std::lround(v)), 0, end); };
    for (int y = pixel(y0, picture.height); y < pixel(y1, picture.height); ++y)
        for (int x = pixel(x0, picture.width); x < pixel(x1, picture.width); ++x)
            for (int c = 0; c < 3; ++c)
                picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                 static_cast<std::size_t>(x)) +
                            static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(rgb >> (16 - 8 * c));
}

} // namespace

std::string svg_of(const Drawing& drawing) {
    const auto number = [](double value) { return "\"" + fixed(value, 1) + "\""; };
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=" + number(drawing.width) +
                      " height=" + number(drawing.height) +
                      " font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const Box& box : drawing.boxes)
        svg += "<rect x=" + number(box.x) + " y=" + number(box.y) + " width=" + number(box.width) +
               " height=" + number(box.height) + " fill=\"" + box.colour + "\"/>\n";
    constexpr const char* anchors[] = {"start", "middle", "end"};
    for (const Label& label : drawing.labels)
        svg += "<text x=" + number(label.x) + " y=" + number(label.y) + " text-anchor=\"" +
               anchors[static_cast<std::size_t>(label.anchor)] + "\" font-size=\"" + std::to_string(label.size) + "\">" +
               escaped(label.text) + "</text>\n";
    return svg + "</svg>\n";
}

Picture8 picture_of(const Drawing& drawing) {
    constexpr double scale = 2;
    Picture8 picture;
    picture.width = static_cast<int>(scale * drawing.width);
    picture.height = static_cast<int>(scale * drawing.height);
    picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 255);
    for (const Box& box : drawing.boxes)
        fill(picture, scale * box.x, scale * box.y, scale * (box.x + box.width), scale * (box.y + box.height),
             static_cast<std::uint32_t>(std::stoul(box.colour.substr(1), nullptr, 16)));
    for (const Label& label : drawing.labels) {
        const double dot = label.size > 13 ? 3 : 2, width = dot * advance * static_cast<double>(label.text.size());
        double x = scale * label.x - width * (static_cast<double>(label.anchor) / 2);
        for (const char c : label.text) {
            const Glyph* const glyph = glyph_of(c);
            for (int column = 0; glyph != nullptr && column < 5; ++column)
                for (int row = 0; row < 7; ++row)
                    if ((glyph->columns[column] >> row & 1) != 0)
                        fill(picture, x + dot * column, scale * label.y - dot * (7 - row), x + dot * (column + 1),
                             scale * label.y - dot * (6 - row), 0x222222);
            x += dot * advance;
        }
    }
    return picture;
}

bool is_png(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".png"; }

void write_drawing(const std::filesystem::path& file, const Drawing& drawing) {
    if (is_png(file))
        write_png(file, picture_of(drawing));
    else
        write_file(file, svg_of(drawing));
}

} // namespace lanecast::bench
