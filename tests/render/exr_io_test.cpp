// What write_exr writes, read back by us and looked at through OpenEXR itself.
#include "render/exr_io.hpp"

#include "output_support.hpp"
#include "render/scrub.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <sys/resource.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

ExrOptions float_options() {
    ExrOptions options;
    options.float_pixels = true;
    return options;
}

/// What a half file must give back for `value`.
float as_half(float value) {
    if (std::isnan(value)) return 0.0f;
    return Imath::half(std::fmax(-65504.0f, std::fmin(65504.0f, value)));
}

rusage usage() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

template <class Expected>
int wrong_values(const Film& written, const Film& read, const Expected& expected) {
    int wrong = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        REQUIRE(written.rgb[c].size() == read.rgb[c].size());
        for (std::size_t i = 0; i < read.rgb[c].size(); ++i)
            wrong += same_bits(read.rgb[c][i], expected(written.rgb[c][i])) ? 0 : 1;
    }
    return wrong;
}

Film random_film(int image_width, int image_height, const Tile& crop, unsigned seed) {
    std::mt19937 random(seed);
    return film_of(image_width, image_height, crop, [&](int, int, int) { return random_finite(random); });
}

} // namespace

TEST_CASE("float files hold every finite value bit for bit") {
    const TemporaryDirectory directory;
    const Film film = random_film(80, 60, {0, 0, 80, 60}, 1);
    write_exr(directory.path / "f.exr", film, float_options());
    CHECK(wrong_values(film, read_exr(directory.path / "f.exr"), [](float v) { return v; }) == 0);
}

TEST_CASE("half files hold the nearest half, clamped to the largest") {
    const TemporaryDirectory directory;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> exponent(-28, 20);
    Film film =
        film_of(120, 90, {0, 0, 120, 90}, [&](int x, int, int) { return (x % 2 ? -1.0f : 1.0f) * std::exp2(exponent(random)); });
    const float edges[] = {0.0f,      -0.0f, 65504.0f,      65505.0f,      65519.9f, 65520.0f,
                           -65520.0f, 1e38f, 5.9604645e-8f, 2.9802322e-8f, 1e-45f};
    std::copy(std::begin(edges), std::end(edges), film.rgb[1].begin());
    write_exr(directory.path / "h.exr", film);
    CHECK(wrong_values(film, read_exr(directory.path / "h.exr"), as_half) == 0);
}

TEST_CASE("films of every size come back, flat, smooth or noise, and no line takes more than its pixels do") {
    const TemporaryDirectory directory;
    std::mt19937 random(12);
    std::uniform_int_distribution<int> side(1, 90), place(0, 40), kind(0, 2);
    int kept_as_they_are = 0;
    const auto size_of_file = [&] { return static_cast<int>(std::filesystem::file_size(directory.path / "f.exr")); };
    write_exr(directory.path / "f.exr", random_film(1, 1, {0, 0, 1, 1}, 1));
    const int head = size_of_file() - 16 - 6; // of a line: where it begins, its y, its size, and here six bytes of pixels
    for (int draw = 0; draw < 400; ++draw) {
        const int width = side(random), height = side(random) / 2 + 1, x0 = place(random), y0 = place(random),
                  pattern = kind(random);
        const Film film = film_of(130, 90, {x0, y0, x0 + width, y0 + height}, [&](int x, int y, int c) {
            return pattern == 0 ? 0.25f : pattern == 1 ? static_cast<float>(x + 2 * y + c) / 256 : random_finite(random);
        });
        ExrOptions options;
        options.float_pixels = draw % 2 == 0;
        options.threads = 1 + draw % 3;
        CAPTURE(width);
        CAPTURE(height);
        CAPTURE(pattern);
        write_exr(directory.path / "f.exr", film, options);
        const Film read = read_exr(directory.path / "f.exr");
        CHECK(read.x0 == x0);
        CHECK(read.y0 == y0);
        CHECK(wrong_values(film, read, [&](float v) { return options.float_pixels ? v : as_half(v); }) == 0);
        const int line = 3 * width * (options.float_pixels ? 4 : 2), most = head + height * (16 + line);
        CHECK(size_of_file() <= most);
        if (pattern == 2 && options.float_pixels) CHECK(size_of_file() == most);
        if (size_of_file() == most) ++kept_as_they_are;
    }
    CHECK(kept_as_they_are > 50);
}

TEST_CASE("no NaN and no infinity reaches a file, and each is counted") {
    const TemporaryDirectory directory;
    Film film = film_of(8, 4, {0, 0, 8, 4}, [](int, int, int) { return 0.25f; });
    film.rgb[0][3] = not_a_number;
    film.rgb[1][0] = -not_a_number;
    film.rgb[1][5] = infinity;
    film.rgb[2][31] = -infinity;
    film.rgb[2][30] = 70000.0f;
    film.rgb[2][29] = -70000.0f;
    film.rgb[2][28] = 65504.0f;
    CHECK(count_not_finite(film) == 4);
    CHECK(count_beyond_half(film) == 2);
    for (const bool float_pixels : {false, true}) {
        ExrOptions options;
        options.float_pixels = float_pixels;
        const float largest = float_pixels ? std::numeric_limits<float>::max() : 65504.0f;
        write_exr(directory.path / "n.exr", film, options);
        const Film read = read_exr(directory.path / "n.exr");
        CHECK(count_not_finite(read) == 0);
        CHECK(read.rgb[0][3] == 0.0f);
        CHECK(read.rgb[1][0] == 0.0f);
        CHECK(read.rgb[1][5] == largest);
        CHECK(read.rgb[2][31] == -largest);
        CHECK(read.rgb[0][0] == 0.25f);
    }
    CHECK(std::isnan(film.rgb[0][3])); // write_exr changes no film; scrub does
    CHECK(scrub(film) == 4);
    CHECK(scrub(film) == 0);
    CHECK(film.rgb[0][3] == 0.0f);
    CHECK(film.rgb[2][31] == -std::numeric_limits<float>::max());
    CHECK(film.rgb[2][30] == 70000.0f);
}

TEST_CASE("a crop's data window lies in the whole image's display window") {
    const TemporaryDirectory directory;
    std::mt19937 random(5);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 100; ++trial) {
        const int width = 1 + below(70), height = 1 + below(50);
        const int x0 = below(width), y0 = below(height);
        const Tile crop{x0, y0, x0 + 1 + below(width - x0), y0 + 1 + below(height - y0)};
        const Film film = random_film(width, height, crop, static_cast<unsigned>(random()));
        const auto path = directory.path / "crop.exr";
        write_exr(path, film, float_options());

        const Imf::InputFile file(path.c_str());
        CHECK(file.header().displayWindow() == Imath::Box2i({0, 0}, {width - 1, height - 1}));
        CHECK(file.header().dataWindow() == Imath::Box2i({crop.x0, crop.y0}, {crop.x1 - 1, crop.y1 - 1}));
        const Film read = read_exr(path);
        CHECK(read.image_width == width);
        CHECK(read.image_height == height);
        CHECK(read.x0 == crop.x0);
        CHECK(read.y0 == crop.y0);
        CHECK(wrong_values(film, read, [](float v) { return v; }) == 0);
    }
}

TEST_CASE("the header says what the pixels are") {
    const TemporaryDirectory directory;
    const Film film = random_film(6, 5, {0, 0, 6, 5}, 9);
    ExrOptions options;
    options.screen_window_width = 1.75f;
    options.attributes = {{"lanecast:scene", "a \"scene\".json"},
                          {"lanecast:threads", 2},
                          {"lanecast:seconds", 0.25},
                          {"lanecast:exposure", -1.5f},
                          {"lanecast:a_name_longer_than_the_31_bytes_of_old", std::string(5000, 'x')},
                          {"comments", "standard"}};
    for (const bool float_pixels : {false, true}) {
        options.float_pixels = float_pixels;
        write_exr(directory.path / "a.exr", film, options);
        const Imf::InputFile file((directory.path / "a.exr").c_str());
        const Imf::Header& header = file.header();
        CHECK(file.isComplete());
        CHECK(header.compression() == Imf::ZIPS_COMPRESSION);
        CHECK(header.lineOrder() == Imf::INCREASING_Y);
        CHECK_FALSE(header.hasTileDescription());
        CHECK(header.pixelAspectRatio() == 1.0f);
        CHECK(header.screenWindowWidth() == 1.75f);
        CHECK(header.screenWindowCenter() == Imath::V2f(0, 0));
        REQUIRE(Imf::hasChromaticities(header));
        const Imf::Chromaticities rec709 = Imf::chromaticities(header);
        CHECK(rec709.red == Imath::V2f(0.64f, 0.33f));
        CHECK(rec709.green == Imath::V2f(0.30f, 0.60f));
        CHECK(rec709.blue == Imath::V2f(0.15f, 0.06f));
        CHECK(rec709.white == Imath::V2f(0.3127f, 0.3290f));
        int channels = 0;
        for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel, ++channels)
            CHECK(channel.channel().type == (float_pixels ? Imf::FLOAT : Imf::HALF));
        CHECK(channels == 3);
        CHECK(header.typedAttribute<Imf::StringAttribute>("lanecast:scene").value() == "a \"scene\".json");
        CHECK(header.typedAttribute<Imf::IntAttribute>("lanecast:threads").value() == 2);
        CHECK(header.typedAttribute<Imf::DoubleAttribute>("lanecast:seconds").value() == 0.25);
        CHECK(header.typedAttribute<Imf::FloatAttribute>("lanecast:exposure").value() == -1.5f);
        CHECK(header.typedAttribute<Imf::StringAttribute>("lanecast:a_name_longer_than_the_31_bytes_of_old").value().size() ==
              5000);
        CHECK(header.typedAttribute<Imf::StringAttribute>("comments").value() == "standard");
    }
}

TEST_CASE("an attribute that would break the file is an error and leaves no file") {
    const TemporaryDirectory directory;
    const Film film = random_film(6, 5, {0, 0, 6, 5}, 9);
    ExrOptions options;
    options.attributes = {{"channels", "none"}};
    const Error error = error_of([&] { write_exr(directory.path / "a.exr", film, options); });
    CHECK(error.code() == ExitCode::output);
    CHECK(contains(error.what(), "a.exr: cannot write: "));
    CHECK(names_in(directory.path).empty());
}

TEST_CASE("equal films give equal bytes, whatever the threads and the order of attributes") {
    const TemporaryDirectory directory;
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 2);
    const Film film =
        film_of(333, 517, {10, 20, 330, 515}, [&](int x, int y, int) { return (x / 9 + y / 7) % 3 ? 0.5f : uniform(random); });
    for (const bool float_pixels : {false, true}) {
        ExrOptions options;
        options.float_pixels = float_pixels;
        options.attributes = {{"lanecast:a", 1}, {"lanecast:b", "two"}};
        write_exr(directory.path / "1.exr", film, options);
        const std::string first = content_of(directory.path / "1.exr");
        CHECK(first.size() > 100000);
        std::swap(options.attributes[0], options.attributes[1]);
        for (const int threads : {1, 2, 3, 8}) {
            options.threads = threads;
            write_exr(directory.path / "2.exr", film, options);
            CHECK(content_of(directory.path / "2.exr") == first);
        }
    }
}

TEST_CASE("files of others: a grey channel, an offset display window, overscan") {
    const TemporaryDirectory directory;
    const std::string path = (directory.path / "y.exr").string();
    Imf::Header header(Imath::Box2i({100, 50}, {109, 55}), Imath::Box2i({98, 49}, {104, 55}));
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    std::vector<Imath::half> y(7 * 7);
    std::vector<float> z(7 * 7, 1e9f);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<float>(i);
    Imf::FrameBuffer pixels;
    pixels.insert("Y", Imf::Slice::Make(Imf::HALF, y.data(), header.dataWindow(), 2, 14));
    pixels.insert("Z", Imf::Slice::Make(Imf::FLOAT, z.data(), header.dataWindow(), 4, 28));
    {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(pixels);
        file.writePixels(7);
    }
    const Film film = read_exr(path);
    CHECK(film.image_width == 10);
    CHECK(film.image_height == 6);
    CHECK(film.x0 == -2);
    CHECK(film.y0 == -1);
    CHECK(film.width == 7);
    CHECK(film.height == 7);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < y.size(); ++i) CHECK(film.rgb[c][i] == static_cast<float>(i));
}

TEST_CASE("what is no EXR, or half a one, is an asset error that names the file") {
    const TemporaryDirectory directory;
    const auto path = directory.path / "bad.exr";
    const auto check_fails = [&] {
        const Error error = error_of([&] { static_cast<void>(read_exr(path)); });
        CHECK(error.code() == ExitCode::asset);
        CHECK(contains(error.what(), path.string() + ": cannot read as OpenEXR: "));
    };
    check_fails(); // missing
    put(path, "");
    check_fails();
    put(path, "P6 512 512 255");
    check_fails();
    write_exr(path, random_film(40, 30, {0, 0, 40, 30}, 3));
    const std::string whole = content_of(path);
    for (std::size_t size = 1; size < whole.size(); size += 97) {
        put(path, whole.substr(0, size));
        check_fails();
    }
    // A data window of 2^24 columns or lines in a file of some kilobytes: refused before memory is taken for it.
    const std::size_t window = whole.find("dataWindow") + std::string("dataWindow.box2i.....").size();
    for (const std::size_t corner : {8u, 12u}) { // of its 16 bytes, x or y of the lower right corner
        std::string liar = whole;
        liar[window + corner + 3] = 1;
        put(path, liar);
        const rusage before = usage();
        check_fails();
        CHECK(usage().ru_maxrss - before.ru_maxrss < 100000); // KiB
    }
    // Bytes changed anywhere: an error or a picture, no crash.
    std::mt19937 random(6);
    for (int trial = 0; trial < 300; ++trial) {
        std::string damaged = whole;
        for (int n = 0; n < 3; ++n) damaged[random() % (trial % 2 ? damaged.size() : 400)] = static_cast<char>(random());
        put(path, damaged);
        const Error error = error_of([&] { static_cast<void>(read_exr(path)); });
        CHECK((error.code() == ExitCode::asset || error.code() == ExitCode::done));
    }
}
