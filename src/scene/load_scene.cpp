#include "scene/load_scene.hpp"

#include "scene/diagnostic.hpp"
#include "scene/load_parts.hpp"
#include "scene/read_file.hpp"
#include "scene/source_map.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <iterator>

namespace lanecast {
namespace {

constexpr const char* trailing_message = "text after the end of the scene is ignored";

[[noreturn]] void fail_syntax(const SceneReader& reader) {
    const SyntaxFault fault = find_syntax_fault(reader.document.source);
    const std::string place = fault.place.empty() ? "" : fault.place + ": ";
    throw Error(ExitCode::scene,
                format_diagnostic(reader.name, reader.document.source, fault.offset, "error", place + fault.message));
}

/// Positions of all remarks by one scan; in the order of the file.
std::vector<std::string> formatted_warnings(SceneReader& reader) {
    const std::string_view source = reader.document.source;
    std::ranges::stable_sort(reader.remarks, {}, &SceneReader::Remark::node);
    std::vector<NodeId> ids;
    for (const SceneReader::Remark& remark : reader.remarks) ids.push_back(remark.node);
    const std::vector<SourceSpan> spans = ids.empty() ? std::vector<SourceSpan>() : locate_nodes(source, ids);
    std::vector<std::string> out;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::string place = pointer_to(reader.document, ids[i]);
        out.push_back(
            format_diagnostic(reader.name, source, spans[i].begin, "warning", place + ": " + reader.remarks[i].message));
    }
    if (reader.document.trailing_text)
        out.push_back(format_diagnostic(reader.name, source, find_trailing_text(source), "warning", trailing_message));
    std::ranges::move(reader.mesh_warnings, std::back_inserter(out));
    if (reader.remarks_dropped > 0) out.push_back(reader.name + ": warning: " + more_warnings(reader.remarks_dropped));
    return out;
}

} // namespace

LoadedScene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                        const LoadOptions& options) {
    SceneReader reader;
    reader.name = printable(name, 4096);
    reader.directory = directory;
    reader.strict = options.strict;
    reader.document.source = text;
    if (!parse_json(reader.document)) fail_syntax(reader);
    if (reader.document.trailing_text && options.strict)
        throw Error(ExitCode::scene, format_diagnostic(reader.name, text, find_trailing_text(text), "error",
                                                       trailing_message + std::string(strict_suffix)));

    LoadedScene out;
    out.description.file = name;
    const Block scene(reader, 0, format::scene);
    out.description.camera = load_camera(reader, scene.find("camera"));
    if (scene.has("render")) out.description.render = load_render_settings(reader, scene.find("render"));
    out.description.objects = load_objects(reader, scene.find("objects"));
    out.description.lights = load_lights(reader, scene.find("lights"));
    out.warnings = formatted_warnings(reader);
    return out;
}

LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    const FileBytes bytes = read_file_or_pipe(file);
    if (!bytes.fault.empty())
        throw Error(ExitCode::scene, printable_path(file) + ": error: cannot read the scene: " + bytes.fault);
    return parse_scene(bytes.view(), file.string(), file.parent_path(), options);
}

} // namespace lanecast
