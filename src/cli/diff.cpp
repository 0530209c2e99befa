#include "cli/diff.hpp"

#include "render/exr_io.hpp"
#include "render/flip.hpp"
#include "render/png_io.hpp"
#include "render/read_picture.hpp"
#include "render/tonemap.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <cstdio>
#include <ostream>
#include <string>

namespace lanecast {
namespace {

/// As %g, so that tables are short; `digits` significant ones.
[[nodiscard]] std::string number(double value, int digits = 6) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

[[nodiscard]] std::string window_of(const Film& film) {
    std::string text = std::to_string(film.image_width) + "x" + std::to_string(film.image_height);
    if (film.width != film.image_width || film.height != film.image_height || film.x0 != 0 || film.y0 != 0)
        text += ", of it " + std::to_string(film.width) + "x" + std::to_string(film.height) + " from (" +
                std::to_string(film.x0) + ", " + std::to_string(film.y0) + ")";
    return text;
}

void print_measures(const Comparison& comparison, double threshold, std::ostream& out) {
    out << "RMSE                " << number(comparison.rmse) << "\n";
    out << "relMSE              " << number(comparison.relmse) << " (of b)\n";
    out << "largest difference  " << number(comparison.largest);
    if (comparison.largest > 0)
        out << " (" << number(255 * comparison.largest, 4) << "/255) at (" << comparison.largest_x << ", " << comparison.largest_y
            << ") in "
            << "RGB"[comparison.largest_channel] << ": " << number(static_cast<double>(comparison.largest_a), 9) << " and "
            << number(static_cast<double>(comparison.largest_b), 9);
    out << "\npixels off          " << number(100 * off_share(comparison), 4) << " % (" << comparison.off_pixels << " of "
        << comparison.pixels << ") by more than " << number(255 * threshold, 4) << "/255\n";
}

/// How a picture is seen: an EXR as the view `srgb` shows it, a PNG's codes as a screen does.
[[nodiscard]] SeenPicture seen(const std::filesystem::path& path, const Film& film) {
    return see(film, picture_kind(path) == PictureKind::png ? PixelValues::codes : PixelValues::linear);
}

void write_difference(const std::filesystem::path& path, const Film& a, const Film& b, const std::optional<float>& scale) {
    if (lower_case(path.extension().string()) == ".exr")
        return write_exr(path, difference_picture(a, b, scale.value_or(1.0f)), {.float_pixels = true, .attributes = {}});
    write_png(path, tonemap(difference_picture(a, b, scale.value_or(16.0f)), View::plain));
}

[[nodiscard]] bool within(const std::optional<double>& limit, double value) { return !limit || value <= *limit; }

[[nodiscard]] bool accepted(const DiffOptions& options, const Comparison& comparison) {
    if (!comparison.same_window) return false;
    if (!options.max_rmse && !options.max_error && !options.max_off_share) return comparison.identical && comparison.largest == 0;
    return within(options.max_rmse, comparison.rmse) && within(options.max_error, comparison.largest) &&
           within(options.max_off_share, off_share(comparison));
}

} // namespace

int run_diff(const DiffOptions& options, std::ostream& out) {
    const std::string extension = lower_case(options.output.extension().string());
    if (!options.output.empty() && extension != ".exr" && extension != ".png")
        throw Error(ExitCode::usage, printable_path(options.output) + ": a difference picture is an .exr or a .png");
    const Film a = read_picture(options.a), b = read_picture(options.b);
    const Comparison comparison = compare(a, b, options.threshold);

    out << "a                   " << printable_path(options.a) << ": " << window_of(a) << "\n";
    out << "b                   " << printable_path(options.b) << ": " << window_of(b) << "\n";
    if (!comparison.same_size) {
        out << "result              the sizes differ\n";
        return static_cast<int>(ExitCode::failure);
    }
    if (picture_kind(options.a) != picture_kind(options.b))
        out << "note                an EXR holds linear values, a PNG those of its view: comparable only for the view `plain`\n";
    print_measures(comparison, options.threshold, out);
    if (comparison.same_window) // of parts of pictures it would be that of their borders
        out << "FLIP                " << number(mean_flip(seen(options.a, a), seen(options.b, b))) << "\n";
    if (!options.output.empty() && comparison.pixels > 0) write_difference(options.output, a, b, options.scale);

    const bool pass = accepted(options, comparison);
    const char* result = comparison.pixels == 0    ? "the windows have no pixel in common"
                         : !comparison.same_window ? "the windows differ; measured over the pixels both hold"
                         : comparison.identical && comparison.largest == 0 ? "identical"
                         : pass                                            ? "within the limits"
                         : comparison.largest == 0                         ? "equal but for the signs of zeros"
                                                                           : "different";
    out << "result              " << result << "\n";
    return static_cast<int>(pass ? ExitCode::done : ExitCode::failure);
}

} // namespace lanecast
