#include "render/exr_io.hpp"

#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <cstdint>
#include <new>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

namespace lanecast {
namespace {

/// More pixels per byte of file are a lie in the header, refused before memory is taken for it: deflate cannot shrink further
/// than 1:1032, DWA deflates one value for 8x8 pixels, and the others shrink less.
[[nodiscard]] std::uint64_t max_pixels_per_byte(Imf::Compression compression) {
    return compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION ? 64 * 1032 : 1032;
}

[[nodiscard]] Error read_error(const std::filesystem::path& path, const std::string& reason) {
    return {ExitCode::asset, printable_path(path) + ": cannot read as OpenEXR: " + reason};
}

struct ChannelNames {
    const char* rgb[3];
};

[[nodiscard]] ChannelNames find_channels(const std::filesystem::path& path, const Imf::ChannelList& channels) {
    ChannelNames names{{"R", "G", "B"}};
    if (!channels.findChannel("R") && !channels.findChannel("G") && !channels.findChannel("B")) names = {{"Y", "Y", "Y"}};
    for (const char* name : names.rgb) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (!channel) throw read_error(path, "it has neither channels R, G and B nor a channel Y");
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw read_error(path, std::string("its channel ") + name + " is subsampled");
        if (channel->type == Imf::UINT)
            throw read_error(path, std::string("its channel ") + name + " holds integers, not half or float");
    }
    return names;
}

[[nodiscard]] Film make_film_of(const std::filesystem::path& path, const Imf::Header& header) {
    const Imath::Box2i &display = header.displayWindow(), &data = header.dataWindow();
    const auto extent = [](int low, int high) { return std::int64_t{high} - low + 1; };
    const std::int64_t width = extent(data.min.x, data.max.x), height = extent(data.min.y, data.max.y);
    const std::uint64_t bytes = std::filesystem::file_size(path);
    if (static_cast<std::uint64_t>(width) >
        bytes * max_pixels_per_byte(header.compression()) / static_cast<std::uint64_t>(height))
        throw read_error(path, "it claims " + std::to_string(width) + "x" + std::to_string(height) + " pixels in " +
                                   std::to_string(bytes) + " bytes");
    const int x0 = data.min.x - display.min.x, y0 = data.min.y - display.min.y;
    return make_film(display.max.x - display.min.x + 1, display.max.y - display.min.y + 1,
                     {x0, y0, x0 + static_cast<int>(width), y0 + static_cast<int>(height)});
}

[[nodiscard]] Film read_film(const std::filesystem::path& path) {
    // In this order, since opening a part takes memory by the header's width.
    Imf::MultiPartInputFile file(path.c_str(), 0);
    const Imf::Header& header = file.header(0);
    const Imath::Box2i& data = header.dataWindow();
    const ChannelNames names = find_channels(path, header.channels());
    Film film = make_film_of(path, header);
    Imf::InputPart part(file, 0);
    // One slice per channel of the file: a Y is read once and copied.
    const bool grey = names.rgb[0] == names.rgb[1];
    Imf::FrameBuffer pixels; // FLOAT slices: the library widens halves
    for (std::size_t c = 0; c < (grey ? 1 : 3); ++c)
        pixels.insert(names.rgb[c], Imf::Slice::Make(Imf::FLOAT, film.rgb[c].data(), data, sizeof(float),
                                                     sizeof(float) * static_cast<std::size_t>(film.width)));
    part.setFrameBuffer(pixels);
    part.readPixels(data.min.y, data.max.y);
    if (grey) film.rgb[1] = film.rgb[2] = film.rgb[0];
    return film;
}

} // namespace

Film read_exr(const std::filesystem::path& path) {
    try {
        return read_film(path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw read_error(path, e.what());
    }
}

} // namespace lanecast
