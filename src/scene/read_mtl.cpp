#include "scene/read_mtl.hpp"

#include "scene/text_cursor.hpp"

namespace lanecast {
namespace {

double not_negative(TextCursor& cursor) {
    cursor.skip_blanks();
    const char* const start = cursor.at;
    const double value = cursor.number("a number");
    if (value < 0) cursor.fail_word(start, "a number of 0 or more");
    return value;
}

/// `r g b`, or `r` alone for a grey. The spectral and xyz forms are left out.
void read_color(TextCursor& cursor, glm::dvec3& color) {
    cursor.skip_blanks();
    const std::string_view rest(cursor.at, static_cast<std::size_t>(cursor.end - cursor.at));
    if (rest.starts_with("spectral") || rest.starts_with("xyz")) return;
    const double red = not_negative(cursor);
    color = glm::dvec3(red);
    if (cursor.at_statement_end()) return;
    color.y = not_negative(cursor);
    color.z = not_negative(cursor);
}

} // namespace

void read_mtl(std::string_view text, const std::string& name, MaterialLibrary& library) {
    TextCursor cursor{.text = text, .name = name};
    bool named = false;
    for (; cursor.at != cursor.end; cursor.skip_statement()) {
        if (cursor.at_statement_end()) continue;
        const char* const start = cursor.at;
        const std::string_view keyword = cursor.word();
        Material& material = library.materials.back();
        if (keyword == "newmtl") {
            named = true;
            library.index[std::string(cursor.rest_of_line())] = static_cast<std::uint32_t>(library.materials.size());
            library.materials.push_back(Material(library.materials.front()));
        } else if (keyword == "Ka" || keyword == "Kd" || keyword == "Ks" || keyword == "Ns") {
            if (!named) cursor.fail(start, "a value before any `newmtl`");
            if (keyword == "Ka") read_color(cursor, material.ambient);
            if (keyword == "Kd") read_color(cursor, material.diffuse);
            if (keyword == "Ks") read_color(cursor, material.specular);
            if (keyword == "Ns") material.shininess = not_negative(cursor);
        }
    }
}

} // namespace lanecast
