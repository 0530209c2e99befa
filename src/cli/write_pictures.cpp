#include "cli/write_pictures.hpp"

#include "render/output_file.hpp"
#include "render/png_io.hpp"
#include "scene/error.hpp"
#include "scene/parallel.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

namespace lanecast {

namespace {

/// Endings by which a user asks for a format. Others are part of the name: "v1.5".
constexpr std::string_view not_written[] = {".jpg", ".jpeg", ".tif", ".tiff", ".bmp",  ".gif",  ".hdr", ".pic", ".tga",
                                            ".ppm", ".pgm",  ".pfm", ".pnm",  ".webp", ".avif", ".jxl", ".dds"};

/// What a PNG says of itself: which settings made it, and what they were picked for.
[[nodiscard]] std::vector<PngText> texts_of(const std::vector<ExrAttribute>& attributes) {
    std::vector<PngText> texts;
    for (const ExrAttribute& a : attributes)
        if (const auto* text = std::get_if<std::string>(&a.value);
            text && (a.name == "lanecast:settings" || a.name == "lanecast:budget"))
            texts.push_back({a.name, *text});
    return texts;
}

} // namespace

PictureNames picture_names(const std::string& output, const std::filesystem::path& scene) {
    const std::size_t dot = output.find_last_of("./"); // `.exr` is a name that ends in .exr here
    const std::string ending = dot == std::string::npos ? "" : lower_case(output.substr(dot));
    if (ending == ".exr") return {output, {}};
    if (ending == ".png") return {{}, output};
    if (std::ranges::find(not_written, ending) != std::end(not_written))
        throw Error(ExitCode::usage,
                    "--output: " + printable_path(output) + ": pictures are written as .exr and .png, not as " + ending);
    std::error_code ignored;
    if (!output.ends_with('/') && std::filesystem::is_directory(output, ignored))
        throw Error(ExitCode::output,
                    printable_path(output) + ": is a directory; " + printable_path(output + "/") + " puts the pictures into it");
    const bool directory = output.empty() || output.ends_with('/');
    const std::string name = directory ? output + scene.stem().string() : output;
    return {name + ".exr", name + ".png"};
}

void probe_outputs(const PictureNames& names) {
    for (const std::filesystem::path& name : {names.exr, names.png})
        if (!name.empty()) const OutputFile probe(name);
}

void write_pictures(const PictureNames& names, const Film& film, const PictureOptions& options,
                    const std::function<void()>& before_commit) {
    std::optional<OutputFile> exr, png;
    if (!names.exr.empty()) exr.emplace(names.exr);
    if (!names.png.empty()) png.emplace(names.png);
    // Below this many pixels for each, starting threads takes longer than they save.
    constexpr int worth_a_thread = 1 << 14;
    const int encoders = std::clamp(film.width * film.height / worth_a_thread, 1, options.threads);
    ExrOptions exr_options = options.exr;
    exr_options.threads = encoders;
    // libpng is one thread's work, and OpenEXR has a pool of its own: the two files are encoded, and synchronised, at the same
    // time.
    parallel_for(options.threads, 2, [&](std::size_t i) {
        if (i == 0 && exr) {
            write_exr(*exr, film, exr_options);
            exr->complete();
        }
        if (i == 1 && png) {
            Picture8 picture = tonemap(film, options.view, options.exposure, encoders);
            picture.texts = texts_of(options.exr.attributes);
            write_png(*png, picture);
            png->complete();
        }
    });
    before_commit();
    if (exr) exr->commit();
    if (png) png->commit();
}

} // namespace lanecast
