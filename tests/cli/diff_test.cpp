// lanecast diff: what it prints, writes and returns.
#include "cli/diff.hpp"

#include "render/exr_io.hpp"
#include "render/output_support.hpp"
#include "render/png_io.hpp"
#include "render/read_picture.hpp"
#include "render/tonemap.hpp"

#include <doctest/doctest.h>

#include <sstream>

using namespace lanecast;
using namespace lanecast::test;

namespace {

struct Outcome {
    int code;
    std::string text;
};

Outcome diff(const DiffOptions& options) {
    std::ostringstream out;
    const int code = run_diff(options, out);
    return {code, out.str()};
}

DiffOptions between(const std::filesystem::path& a, const std::filesystem::path& b) {
    DiffOptions options;
    options.a = a;
    options.b = b;
    return options;
}

Film some_film(const Tile& crop = {0, 0, 32, 24}) {
    return film_of(32, 24, crop, [](int x, int y, int c) { return static_cast<float>(x + y + c) / 64.0f; });
}

} // namespace

TEST_CASE("equal pictures are 0, whatever the container; any other bit is 1") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", b = directory.path / "b.exr", png = directory.path / "p.png";
    Film film = some_film();
    write_exr(a, film);
    write_exr(b, film, {.float_pixels = true, .attributes = {{"lanecast:host", "another"}}});
    Outcome outcome = diff(between(a, b));
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.text, "result              identical"));

    film.rgb[1][5 * 32 + 7] += 0.25f;
    write_exr(b, film);
    outcome = diff(between(a, b));
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.text, "largest difference  0.25 (63.75/255) at (7, 5) in G: 0.203125 and 0.453125"));
    CHECK(contains(outcome.text, "(1 of 768)"));
    CHECK(contains(outcome.text, "result              different"));

    film = some_film();
    film.rgb[0][0] = -0.0f;
    write_exr(b, film);
    outcome = diff(between(a, b));
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.text, "signs of zeros"));

    write_png(png, tonemap(some_film(), View::plain));
    CHECK(diff(between(png, png)).code == 0);
    outcome = diff(between(a, png));
    CHECK(outcome.code == 1); // rounded to 8 bits
    CHECK(contains(outcome.text, "note"));
    DiffOptions rounded = between(a, png);
    rounded.max_error = 0.51 / 255;
    CHECK(diff(rounded).code == 0);
}

TEST_CASE("limits: each given one counts, and only those") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", b = directory.path / "b.exr";
    Film film = some_film();
    write_exr(a, film);
    film.rgb[2][0] += 0.5f; // RMSE 0.5 / 48, largest 0.5, 1 of 768 off
    write_exr(b, film);
    const auto code = [&](std::optional<double> rmse, std::optional<double> error, std::optional<double> share) {
        DiffOptions options = between(a, b);
        options.max_rmse = rmse, options.max_error = error, options.max_off_share = share;
        return diff(options).code;
    };
    CHECK(code(0.5 / 48 + 1e-9, {}, {}) == 0);
    CHECK(code(0.5 / 48 - 1e-9, {}, {}) == 1);
    CHECK(code({}, 0.5, {}) == 0);
    CHECK(code({}, 0.4999, {}) == 1);
    CHECK(code({}, {}, 1.0 / 768) == 0);
    CHECK(code({}, {}, 0.999 / 768) == 1);
    CHECK(code(1, 1, 0) == 1);
    CHECK(code(1, 1, 1) == 0);
    DiffOptions options = between(a, b);
    options.max_off_share = 0;
    options.threshold = 0.6;
    CHECK(diff(options).code == 0);
}

TEST_CASE("a difference picture is written for either kind") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", b = directory.path / "b.exr";
    Film film = some_film();
    write_exr(a, film);
    film.rgb[0][0] += 0.25f;
    film.rgb[1][1] += 1.0f / 64;
    write_exr(b, film);
    DiffOptions options = between(a, b);
    options.output = directory.path / "d.exr";
    CHECK(diff(options).code == 1);
    CHECK(picture_kind(options.output) == PictureKind::exr);
    Film picture = read_picture(options.output);
    CHECK(picture.rgb[0][0] == 0.25f);
    CHECK(picture.rgb[1][1] == 1.0f / 64);
    CHECK(picture.rgb[2][0] == 0.0f);

    options.output = directory.path / "d.png";
    CHECK(diff(options).code == 1);
    CHECK(picture_kind(options.output) == PictureKind::png);
    picture = read_picture(options.output);
    CHECK(picture.rgb[0][0] == 1.0f);
    CHECK(picture.rgb[1][1] == 64.0f / 255);
    CHECK(picture.rgb[2][0] == 0.0f);

    options.output = directory.path / "d.jpg";
    const Error error = error_of([&] { static_cast<void>(diff(options)); });
    CHECK(error.code() == ExitCode::usage);
    options.output = directory.path / "none" / "d.png";
    CHECK(error_of([&] { static_cast<void>(diff(options)); }).code() == ExitCode::output);
}

TEST_CASE("sizes and windows that differ are a difference, whatever the limits") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", b = directory.path / "b.exr", c = directory.path / "c.exr";
    write_exr(a, some_film());
    write_exr(b, some_film({4, 5, 20, 15}));
    write_exr(c, film_of(31, 24, {0, 0, 31, 24}, [](int, int, int) { return 0.0f; }));
    DiffOptions options = between(a, b);
    options.max_error = 100;
    Outcome outcome = diff(options);
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.text, "32x24, of it 16x10 from (4, 5)"));
    CHECK(contains(outcome.text, "the windows differ"));
    CHECK(contains(outcome.text, "(0 of 160)"));
    options.b = c;
    outcome = diff(options);
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.text, "the sizes differ"));

    write_exr(c, some_film({20, 5, 30, 15}));
    options = between(b, c);
    for (const char* name : {"d.exr", "d.png"}) { // no pixel to make a difference picture of
        options.output = directory.path / name;
        outcome = diff(options);
        CHECK(outcome.code == 1);
        CHECK(contains(outcome.text, "no pixel in common"));
        CHECK(!std::filesystem::exists(options.output));
    }
}

TEST_CASE("what cannot be read is an asset error that names the file") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", bad = directory.path / "bad.exr";
    write_exr(a, some_film());
    put(bad, "text");
    for (const auto& path : {directory.path / "missing.exr", bad, directory.path}) {
        const Error error = error_of([&] { static_cast<void>(diff(between(a, path))); });
        CHECK(error.code() == ExitCode::asset);
        CHECK(contains(error.what(), path.string() + ": cannot read: "));
    }
}

TEST_CASE("FLIP is that of what is shown: a PNG's codes and the radiance behind them look the same") {
    const TemporaryDirectory directory;
    const auto a = directory.path / "a.exr", b = directory.path / "b.exr", pa = directory.path / "a.png",
               pb = directory.path / "b.png";
    const Film dark = film_of(24, 24, {0, 0, 24, 24}, [](int x, int, int) { return 0.1f + 0.01f * static_cast<float>(x); });
    const Film light = film_of(24, 24, {0, 0, 24, 24}, [](int x, int, int) { return 0.2f + 0.01f * static_cast<float>(x); });
    write_exr(a, dark, {.float_pixels = true, .attributes = {}});
    write_exr(b, light, {.float_pixels = true, .attributes = {}});
    write_png(pa, tonemap(dark, View::srgb));
    write_png(pb, tonemap(light, View::srgb));
    const auto flip = [](const std::string& text) { return std::stod(text.substr(text.find("\nFLIP ") + 6)); };
    const double linear = flip(diff(between(a, b)).text), codes = flip(diff(between(pa, pb)).text);
    CHECK(linear > 0.05);
    CHECK(codes == doctest::Approx(linear).epsilon(0.02));
    CHECK(flip(diff(between(a, a)).text) == 0);
}
