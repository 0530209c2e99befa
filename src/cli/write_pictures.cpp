#include "cli/write_pictures.hpp"

#include "render/output_file.hpp"
#include "render/png_io.hpp"
#include "scene/parallel.hpp"

#include <optional>

namespace lanecast {

PictureNames picture_names(const std::string& output, const std::filesystem::path& scene) {
    if (output.ends_with(".exr")) return {output, {}};
    if (output.ends_with(".png")) return {{}, output};
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
    // libpng is one thread's work, and OpenEXR has a pool of its own: the two files are encoded at the same time.
    parallel_for(options.threads, 2, [&](std::size_t i) {
        if (i == 0 && exr) {
            write_exr(*exr, film, options.exr);
            exr->complete();
        }
        if (i == 1 && png) {
            write_png(*png, tonemap(film, options.view, options.exposure, options.threads));
            png->complete();
        }
    });
    before_commit();
    if (exr) exr->commit();
    if (png) png->commit();
}

} // namespace lanecast
