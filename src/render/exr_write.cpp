#include "render/exr_io.hpp"

#include "render/half_float.hpp"
#include "render/output_file.hpp"
#include "render/parallel_rows.hpp"
#include "render/scrub.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

namespace lanecast {
namespace {

constexpr const char* channel_names[3] = {"R", "G", "B"};

class ExrStream final : public Imf::OStream {
public:
    ExrStream(OutputFile& file, const char* name) : OStream(name), file_(file) {}
    void write(const char data[], int size) override {
        if (!file_.write(data, static_cast<std::size_t>(size))) throw file_.error();
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override {
        if (!file_.seek(position)) throw file_.error();
    }

private:
    OutputFile& file_;
};

void insert_attribute(Imf::Header& header, const std::string& name, const std::string& value) {
    header.insert(name, Imf::StringAttribute(value));
}
void insert_attribute(Imf::Header& header, const std::string& name, int value) { header.insert(name, Imf::IntAttribute(value)); }
void insert_attribute(Imf::Header& header, const std::string& name, float value) {
    header.insert(name, Imf::FloatAttribute(value));
}
void insert_attribute(Imf::Header& header, const std::string& name, double value) {
    header.insert(name, Imf::DoubleAttribute(value));
}

[[nodiscard]] Imf::Header make_header(const Film& film, const ExrOptions& options) {
    const Imath::Box2i display({0, 0}, {film.image_width - 1, film.image_height - 1});
    const Imath::Box2i data({film.x0, film.y0}, {film.x0 + film.width - 1, film.y0 + film.height - 1});
    Imf::Header header(display, data, 1.0f, {0.0f, 0.0f}, options.screen_window_width, Imf::INCREASING_Y, Imf::ZIPS_COMPRESSION);
    Imf::addChromaticities(header, Imf::Chromaticities()); // Rec.709 primaries and D65, by its default
    const Imf::PixelType type = options.float_pixels ? Imf::FLOAT : Imf::HALF;
    for (const char* name : channel_names) header.channels().insert(name, Imf::Channel(type));
    for (const ExrAttribute& attribute : options.attributes)
        std::visit([&](const auto& value) { insert_attribute(header, attribute.name, value); }, attribute.value);
    return header;
}

/// OpenEXR's pool belongs to the process and starts empty; it is grown, never shrunk, so that films can be written concurrently.
void ensure_pool(int threads) {
    static std::mutex growing;
    const std::lock_guard lock(growing);
    if (threads > 1 && Imf::globalThreadCount() < threads) Imf::setGlobalThreadCount(threads);
}

/// `pixels` holds three planes, each the film's size, of the header's type.
void write_planes(OutputFile& file, const std::string& name, const Imf::Header& header, const char* const planes[3],
                  int threads) {
    ExrStream stream(file, name.c_str());
    const Imath::Box2i& window = header.dataWindow();
    const Imf::PixelType type = header.channels().begin().channel().type;
    const std::size_t stride = type == Imf::HALF ? sizeof(std::uint16_t) : sizeof(float);
    const std::size_t row = stride * static_cast<std::size_t>(window.max.x - window.min.x + 1);
    Imf::FrameBuffer pixels;
    for (int c = 0; c < 3; ++c) pixels.insert(channel_names[c], Imf::Slice::Make(type, planes[c], window, stride, row));
    ensure_pool(threads);
    Imf::OutputFile exr(stream, header, threads > 1 ? threads : 0);
    exr.setFrameBuffer(pixels);
    exr.writePixels(window.max.y - window.min.y + 1); // one call: lines are compressed in parallel within a call only
} // the file's destructor writes the line table and swallows errors; OutputFile remembers them

void write_half(OutputFile& file, const std::string& name, const Film& film, const ExrOptions& options) {
    std::vector<std::uint16_t> halves[3];
    const char* planes[3];
    for (std::size_t c = 0; c < 3; ++c) {
        halves[c].resize(film.rgb[c].size());
        planes[c] = reinterpret_cast<const char*>(halves[c].data());
    }
    for_each_row_band(film.height, options.threads, [&](int first_row, int last_row) {
        const std::size_t width = static_cast<std::size_t>(film.width);
        const std::size_t first = width * static_cast<std::size_t>(first_row), last = width * static_cast<std::size_t>(last_row);
        for (std::size_t c = 0; c < 3; ++c) {
            const float* from = film.rgb[c].data();
            std::uint16_t* to = halves[c].data();
            for (std::size_t i = first; i < last; ++i) {
                const float number = from[i] == from[i] ? from[i] : 0.0f;
                to[i] = half_bits(std::clamp(number, -largest_half, largest_half));
            }
        }
    });
    write_planes(file, name, make_header(film, options), planes, options.threads);
}

void write_float(OutputFile& file, const std::string& name, const Film& film, const ExrOptions& options) {
    if (count_not_finite(film) > 0) {
        Film scrubbed = film;
        scrub(scrubbed);
        return write_float(file, name, scrubbed, options);
    }
    const char* planes[3];
    for (std::size_t c = 0; c < 3; ++c) planes[c] = reinterpret_cast<const char*>(film.rgb[c].data());
    write_planes(file, name, make_header(film, options), planes, options.threads);
}

} // namespace

void write_exr(OutputFile& file, const Film& film, const ExrOptions& options) {
    const std::string name = printable_path(file.path());
    try {
        (options.float_pixels ? write_float : write_half)(file, name, film, options);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        if (file.failed()) throw file.error();
        throw Error(ExitCode::output, name + ": cannot write: " + e.what());
    }
}

void write_exr(const std::filesystem::path& path, const Film& film, const ExrOptions& options) {
    OutputFile file(path);
    write_exr(file, film, options);
    file.commit();
}

} // namespace lanecast
