#include "render/png_io.hpp"

#include "render/deflate.hpp"
#include "render/output_file.hpp"
#include "render/png_errors.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <csetjmp>
#include <string>
#include <vector>

#include <png.h>

namespace lanecast {
namespace {

void write_to_file(png_structp png, png_bytep data, png_size_t size) {
    if (!static_cast<OutputFile*>(png_get_io_ptr(png))->write(data, size)) png_error(png, "write failed");
}

void flush_nothing(png_structp) {}

/// What IDAT chunks hold: the rows, each byte as its difference from the pixel to the left (filter SUB), as one zlib stream.
/// Measured: docs/output.md.
[[nodiscard]] ZeroVector<unsigned char> compressed_rows(const Picture8& picture) {
    constexpr std::size_t channels = 3;
    const std::size_t row = channels * static_cast<std::size_t>(picture.width), rows = static_cast<std::size_t>(picture.height);
    ZeroVector<unsigned char> filtered((row + 1) * rows);
    unsigned char* to = filtered.data();
    for (std::size_t y = 0; y < rows; ++y, to += row + 1) {
        const std::uint8_t* const from = picture.rgb.data() + row * y;
        to[0] = PNG_FILTER_VALUE_SUB;
        std::copy_n(from, channels, to + 1);
        for (std::size_t i = channels; i < row; ++i) to[1 + i] = static_cast<unsigned char>(from[i] - from[i - channels]);
    }
    Deflater deflater(1);
    ZeroVector<unsigned char> stream(deflater.bound(filtered.size()));
    stream.resize(deflater.compress(filtered.data(), filtered.size(), stream.data(), stream.size()));
    return stream;
}

void write_chunk(png_structp png, const char* name, const unsigned char* data, std::size_t size) {
    png_write_chunk(png, reinterpret_cast<png_const_bytep>(name), data, size);
}

/// libpng leaves by longjmp, so this frame and those below it hold nothing that needs a destructor.
[[nodiscard]] bool encode(png_structp png, png_infop info, OutputFile& file, const Picture8& picture,
                          const std::vector<png_text>& texts, const ZeroVector<unsigned char>& rows) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &file, write_to_file, flush_nothing);
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    // sRGB, and for readers that do not know it the gAMA and cHRM the specification recommends beside it (PNG 3rd ed., 11.3.2).
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    constexpr std::size_t most = 1 << 16; // readers that hold a chunk need no more memory than this
    for (std::size_t at = 0; at < rows.size(); at += most)
        write_chunk(png, "IDAT", rows.data() + at, std::min(most, rows.size() - at));
    write_chunk(png, "IEND", nullptr, 0); // png_write_end wants rows that libpng compressed
    return true;
}

} // namespace

void write_png(OutputFile& file, const Picture8& picture) {
    std::vector<png_text> texts;
    for (const PngText& text : picture.texts) {
        png_text chunk{};
        chunk.compression = PNG_TEXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(text.key.c_str()); // libpng copies
        chunk.text = const_cast<char*>(text.text.c_str());
        chunk.text_length = text.text.size();
        texts.push_back(chunk);
    }
    const ZeroVector<unsigned char> rows = compressed_rows(picture);
    PngReason reason;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &reason, keep_png_reason, ignore_png_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool encoded = info && encode(png, info, file, picture, texts, rows);
    png_destroy_write_struct(&png, &info);
    if (file.failed()) throw file.error();
    if (!encoded) throw Error(ExitCode::output, printable_path(file.path()) + ": cannot write: " + reason.text);
}

void write_png(const std::filesystem::path& path, const Picture8& picture) {
    OutputFile file(path);
    write_png(file, picture);
    file.commit();
}

} // namespace lanecast
