#include "render/exr_io.hpp"

#include "render/exr_lines.hpp"
#include "render/output_file.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cstdint>
#include <new>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

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

/// A file of one part (OpenEXR File Layout): OpenEXR writes the header; the rest is where each line begins, and the lines.
/// Its own classes compress by zlib up to 3.1, which takes two to four times as long (docs/output.md).
void write_file_of(OutputFile& file, const std::string& name, const Film& film, const ExrOptions& options) {
    const Imf::Header header = make_header(film, options);
    header.sanityCheck();
    const std::vector<ExrLines> bands = compress_lines(film, options.float_pixels, options.threads);
    ExrStream stream(file, name.c_str());
    const auto put = [&](const void* data, std::size_t size) {
        if (!file.write(data, size)) throw file.error();
    };
    const bool long_names = std::ranges::any_of(options.attributes, [](const ExrAttribute& a) { return a.name.size() > 31; });
    const std::int32_t start[2] = {Imf::MAGIC, Imf::EXR_VERSION | (long_names ? Imf::LONG_NAMES_FLAG : 0)};
    put(start, sizeof start);
    header.writeTo(stream);
    std::uint64_t position = file.position() + sizeof position * static_cast<std::uint64_t>(film.height);
    for (const ExrLines& band : bands)
        for (const std::uint32_t size : band.sizes) {
            put(&position, sizeof position);
            position += size;
        }
    for (const ExrLines& band : bands) put(band.bytes.data(), band.bytes.size());
}

} // namespace

void write_exr(OutputFile& file, const Film& film, const ExrOptions& options) {
    const std::string name = printable_path(file.path());
    try {
        write_file_of(file, name, film, options);
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
