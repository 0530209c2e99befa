#include "render/png_io.hpp"

#include "render/png_errors.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

#include <png.h>

namespace lanecast {
namespace {

// deflate cannot shrink further than 1:1032; a header that claims more is refused before memory is taken for it.
constexpr std::uint64_t max_ratio = 1032;

struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    PngReason reason;

    PngReader() {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reason, keep_png_reason, ignore_png_warning);
        if (png) info = png_create_info_struct(png);
    }
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

// libpng leaves by longjmp: these two hold nothing that needs a destructor. Both are false after an error.

[[nodiscard]] bool read_header(PngReader& reader, std::FILE* file) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_init_io(reader.png, file);
    png_read_info(reader.png, reader.info);
    return true;
}

/// As RGB of 8 or 16 bits, without alpha.
[[nodiscard]] bool read_pixels(PngReader& reader, png_bytepp rows) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_expand(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_strip_alpha(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

[[nodiscard]] Error read_error(const std::filesystem::path& path, const std::string& reason) {
    return {ExitCode::asset, printable_path(path) + ": cannot read as PNG: " + reason};
}

} // namespace

Film read_png(const std::filesystem::path& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw read_error(path, std::generic_category().message(errno));
    PngReader reader;
    if (!reader.info) throw std::bad_alloc();
    if (!read_header(reader, file.get())) throw read_error(path, reader.reason.text);

    const std::size_t width = png_get_image_width(reader.png, reader.info),
                      height = png_get_image_height(reader.png, reader.info);
    const std::size_t sample = png_get_bit_depth(reader.png, reader.info) == 16 ? 2 : 1;
    const std::uint64_t bytes = std::filesystem::file_size(path);
    if (png_get_rowbytes(reader.png, reader.info) * height / max_ratio > bytes)
        throw read_error(path, "it claims " + std::to_string(width) + "x" + std::to_string(height) + " pixels in " +
                                   std::to_string(bytes) + " bytes");

    std::vector<std::uint8_t> codes(3 * sample * width * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = codes.data() + y * 3 * sample * width;
    if (!read_pixels(reader, rows.data())) throw read_error(path, reader.reason.text);

    Film film =
        make_film(static_cast<int>(width), static_cast<int>(height), {0, 0, static_cast<int>(width), static_cast<int>(height)});
    for (std::size_t i = 0; i < width * height; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint8_t* code = codes.data() + (3 * i + c) * sample;
            film.rgb[c][i] =
                sample == 2 ? static_cast<float>(code[0] << 8 | code[1]) / 65535.0f : static_cast<float>(code[0]) / 255.0f;
        }
    return film;
}

} // namespace lanecast
