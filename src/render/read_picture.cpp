#include "render/read_picture.hpp"

#include "render/exr_io.hpp"
#include "render/png_io.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace lanecast {

PictureKind picture_kind(const std::filesystem::path& path) {
    const auto fail = [&](const std::string& reason) {
        return Error(ExitCode::asset, printable_path(path) + ": cannot read: " + reason);
    };
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored) &&
        !std::filesystem::is_directory(path, ignored))
        throw fail("Not a regular file"); // a pipe without a writer would block
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw fail(std::generic_category().message(errno));
    std::array<unsigned char, 4> magic{};
    errno = 0;
    const std::size_t size = std::fread(magic.data(), 1, magic.size(), file.get());
    if (std::ferror(file.get())) throw fail(std::generic_category().message(errno)); // a directory opens, but cannot be read
    if (size == magic.size() && magic == std::array<unsigned char, 4>{0x76, 0x2f, 0x31, 0x01}) return PictureKind::exr;
    if (size == magic.size() && magic == std::array<unsigned char, 4>{0x89, 'P', 'N', 'G'}) return PictureKind::png;
    throw fail("it is neither an OpenEXR nor a PNG file");
}

Film read_picture(const std::filesystem::path& path) {
    return picture_kind(path) == PictureKind::exr ? read_exr(path) : read_png(path);
}

} // namespace lanecast
