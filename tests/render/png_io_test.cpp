// PNG files: what is written is read, by libpng and by us, with the chunks that say what it means.
#include "render/png_io.hpp"

#include "output_support.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include <png.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

Picture8 random_picture(int width, int height, unsigned seed) {
    Picture8 picture{width, height, ZeroVector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
    std::mt19937 random(seed);
    for (auto& code : picture.rgb) code = static_cast<std::uint8_t>(random());
    return picture;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
    return value;
}

struct Chunk {
    std::string name, data;
};

/// Without libpng, so that nothing is skipped.
std::vector<Chunk> chunks_of(const std::string& png) {
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < png.size(); at += 12 + big_endian(png, at))
        chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, big_endian(png, at))});
    return chunks;
}

std::string data_of(const std::vector<Chunk>& chunks, const std::string& name) {
    for (const Chunk& chunk : chunks)
        if (chunk.name == name) return chunk.data;
    return "absent";
}

/// A file of any kind of pixels, by libpng's low-level interface; `rows` are packed as the format says.
void write_any(const std::filesystem::path& path, int width, int height, int depth, int type, bool interlaced,
               std::vector<std::vector<std::uint8_t>> rows) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth, type,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[4] = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}, {255, 0, 128}};
    if (type == PNG_COLOR_TYPE_PALETTE) {
        png_byte alpha[2] = {0, 128};
        png_set_PLTE(png, info, palette, 4);
        png_set_tRNS(png, info, alpha, 2, nullptr);
    }
    std::vector<png_bytep> pointers;
    for (auto& row : rows) pointers.push_back(row.data());
    png_write_info(png, info);
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

} // namespace

TEST_CASE("a picture comes back code for code, through libpng's reader and ours") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "a.png";
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}, {257, 129}, {640, 480}}) {
        const Picture8 picture = random_picture(width, height, static_cast<unsigned>(width));
        write_png(path, picture);

        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_file(&image, path.c_str()));
        CHECK(image.format == PNG_FORMAT_RGB);
        REQUIRE(image.width == static_cast<unsigned>(width));
        REQUIRE(image.height == static_cast<unsigned>(height));
        ZeroVector<std::uint8_t> codes(picture.rgb.size());
        REQUIRE(png_image_finish_read(&image, nullptr, codes.data(), 0, nullptr));
        CHECK(codes == picture.rgb);

        const Film film = read_png(path);
        CHECK(film.image_width == width);
        CHECK(film.image_height == height);
        int wrong = 0;
        for (std::size_t i = 0; i < codes.size(); ++i)
            wrong += film.rgb[i % 3][i / 3] == static_cast<float>(codes[i]) / 255.0f ? 0 : 1;
        CHECK(wrong == 0);
    }
}

TEST_CASE("the chunks say sRGB, and for old readers its gamma and primaries; equal pictures give equal bytes") {
    const TemporaryDirectory directory;
    write_png(directory.path / "a.png", random_picture(300, 200, 1));
    write_png(directory.path / "b.png", random_picture(300, 200, 1));
    CHECK(content_of(directory.path / "a.png") == content_of(directory.path / "b.png"));
    const std::vector<Chunk> chunks = chunks_of(content_of(directory.path / "a.png"));
    CHECK(chunks.front().name == "IHDR");
    CHECK(chunks.front().data.substr(8) == std::string("\x08\x02\0\0\0", 5)); // 8 bit, RGB, not interlaced
    CHECK(chunks.back().name == "IEND");
    CHECK(data_of(chunks, "sRGB") == std::string(1, '\0')); // perceptual
    CHECK(big_endian(data_of(chunks, "gAMA"), 0) == 45455);
    const std::uint32_t chromaticities[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    const std::string data = data_of(chunks, "cHRM");
    REQUIRE(data.size() == 32);
    for (std::size_t i = 0; i < 8; ++i) CHECK(big_endian(data, 4 * i) == chromaticities[i]);
    for (const Chunk& chunk : chunks)
        CHECK((chunk.name != "tIME" && chunk.name != "tEXt")); // nothing that changes from run to run
}

TEST_CASE("every kind of PNG reads as RGB") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "any.png";
    const auto pixel = [&](std::size_t i) {
        const Film film = read_png(path);
        return std::array<float, 3>{film.rgb[0].at(i), film.rgb[1].at(i), film.rgb[2].at(i)};
    };
    for (const bool interlaced : {false, true}) {
        write_any(path, 2, 1, 16, PNG_COLOR_TYPE_RGB, interlaced, {{0x12, 0x34, 0xff, 0xff, 0, 1, 0, 0, 0, 0, 0x80, 0}});
        CHECK(pixel(0) == std::array{0x1234 / 65535.0f, 1.0f, 1 / 65535.0f});
        CHECK(pixel(1) == std::array{0.0f, 0.0f, 0x8000 / 65535.0f});
        write_any(path, 2, 2, 8, PNG_COLOR_TYPE_RGB_ALPHA, interlaced,
                  {{1, 2, 3, 0, 4, 5, 6, 255}, {7, 8, 9, 128, 10, 11, 12, 1}});
        CHECK(pixel(0) == std::array{1 / 255.0f, 2 / 255.0f, 3 / 255.0f}); // alpha is ignored, not applied
        CHECK(pixel(2) == std::array{7 / 255.0f, 8 / 255.0f, 9 / 255.0f});
        write_any(path, 9, 1, 1, PNG_COLOR_TYPE_GRAY, interlaced, {{0b10100000, 0b10000000}});
        CHECK(pixel(0) == std::array{1.0f, 1.0f, 1.0f});
        CHECK(pixel(1) == std::array{0.0f, 0.0f, 0.0f});
        CHECK(pixel(8) == std::array{1.0f, 1.0f, 1.0f});
        write_any(path, 1, 1, 16, PNG_COLOR_TYPE_GRAY_ALPHA, interlaced, {{0x01, 0x02, 0, 0}});
        CHECK(pixel(0) == std::array{0x102 / 65535.0f, 0x102 / 65535.0f, 0x102 / 65535.0f});
        write_any(path, 4, 1, 2, PNG_COLOR_TYPE_PALETTE, interlaced, {{0b00011011}});
        CHECK(pixel(0) == std::array{10 / 255.0f, 20 / 255.0f, 30 / 255.0f});
        CHECK(pixel(3) == std::array{1.0f, 0.0f, 128 / 255.0f});
    }
}

TEST_CASE("what is no PNG, or half a one, is an asset error that names the file") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "bad.png";
    const auto check_fails = [&] {
        const Error error = error_of([&] { static_cast<void>(read_png(path)); });
        CHECK(error.code() == ExitCode::asset);
        CHECK(contains(error.what(), path.string() + ": cannot read as PNG: "));
    };
    check_fails(); // missing
    put(path, "");
    check_fails();
    put(path, "not a picture");
    check_fails();
    write_png(path, random_picture(40, 30, 2));
    const std::string whole = content_of(path);
    for (std::size_t size = 1; size < whole.size(); size += 61) {
        put(path, whole.substr(0, size));
        check_fails();
    }
    std::mt19937 random(3);
    for (int trial = 0; trial < 300; ++trial) { // a changed byte spoils a checksum, or lies in the header
        std::string damaged = whole;
        damaged[random() % damaged.size()] ^= static_cast<char>(1 + random() % 255);
        put(path, damaged);
        const Error error = error_of([&] { static_cast<void>(read_png(path)); });
        CHECK((error.code() == ExitCode::asset || error.code() == ExitCode::done));
    }
}

TEST_CASE("a header that claims more pixels than its bytes can hold takes no memory") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "liar.png";
    // 60000 x 60000 with a right checksum: libpng's writer stops after the header.
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_init_io(png, file);
    png_set_IHDR(png, info, 60000, 60000, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    png_byte idat[] = {0x78, 0x01};
    png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), idat, sizeof idat);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
    const Error error = error_of([&] { static_cast<void>(read_png(path)); });
    CHECK(error.code() == ExitCode::asset);
    CHECK(contains(error.what(), "claims 60000x60000 pixels"));
}
