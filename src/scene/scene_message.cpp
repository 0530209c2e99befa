#include "scene/scene_message.hpp"

#include "scene/diagnostic.hpp"
#include "scene/read_file.hpp"
#include "scene/source_map.hpp"
#include "scene/text_tools.hpp"

namespace lanecast {

std::string message_in_scene(const std::filesystem::path& file, std::string_view severity, std::string_view message) {
    const std::string name = printable_path(file);
    const std::string unplaced = name + ": " + std::string(severity) + ": " + std::string(message);
    std::error_code ignored;
    if (!message.starts_with('/') || !std::filesystem::is_regular_file(file, ignored)) return unplaced; // a pipe is empty by now
    const FileBytes bytes = read_file(file);
    JsonDocument document;
    document.source = bytes.view();
    if (!bytes.fault.empty() || !parse_json(document)) return unplaced; // it has changed since it was loaded
    const NodeId node = node_at(document, message.substr(0, message.find_first_of(": ")));
    if (node == no_node) return unplaced;
    return format_diagnostic(name, bytes.view(), locate_nodes(bytes.view(), {node}).front().begin, severity, message);
}

} // namespace lanecast
