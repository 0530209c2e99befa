#pragma once
// Typed access to a scene's JSON: every block is checked against its table once, then read without further ado.

#include "scene/error.hpp"
#include "scene/json_document.hpp"
#include "scene/scene_format.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast {

struct SceneReader {
    struct Remark {
        NodeId node = 0;
        std::string message;
    };
    std::string name;                ///< of the scene, in messages
    std::filesystem::path directory; ///< of its mesh files
    bool strict = false;             ///< the first warning is an error
    JsonDocument document;
    std::vector<Remark> remarks;            ///< warnings about the scene's text
    std::size_t remarks_dropped = 0;        ///< beyond max_remarks
    std::size_t mesh_elements = 0;          ///< triangles so far
    std::vector<std::string> mesh_warnings; ///< complete messages
};
inline constexpr std::size_t max_remarks = 50;

/// `name:line:column: error: /place: message`, the source line, a caret.
[[noreturn]] void fail(const SceneReader& reader, NodeId node, const std::string& message, ExitCode code = ExitCode::scene);
void warn(SceneReader& reader, NodeId node, const std::string& message);

/// The same form for any severity, without throwing.
[[nodiscard]] std::string message_at(const SceneReader& reader, NodeId node, std::string_view severity,
                                     const std::string& message);

/// "1 more warning", "20 more warnings".
[[nodiscard]] std::string more_warnings(std::size_t count);

/// "-1", "\"abc\"", "a list of 4": to follow "got".
[[nodiscard]] std::string shown(const SceneReader& reader, NodeId node);

/// Items of `list`, which a Block has found to be one.
[[nodiscard]] std::vector<NodeId> items(const SceneReader& reader, NodeId list);

/// An object of the file together with its table.
class Block {
public:
    /// Checks every key: unknown and repeated ones, missing ones, and each value's type, length and range.
    Block(SceneReader& reader, NodeId node, const BlockSpec& spec);

    [[nodiscard]] NodeId node() const { return node_; }
    [[nodiscard]] NodeId find(std::string_view key) const; ///< its value, or no_node
    [[nodiscard]] bool has(std::string_view key) const { return find(key) != no_node; }
    [[nodiscard]] NodeId place_of(std::string_view key) const;         ///< its value, or this block
    [[nodiscard]] std::string misspelling(std::string_view key) const; ///< "; was `raduis` meant for it?", or nothing

    // Sets `value` if the key is there. The key must be of that kind in the table.
    void read(std::string_view key, double& value) const;
    void read(std::string_view key, int& value) const;
    void read(std::string_view key, bool& value) const;
    void read(std::string_view key, std::string& value) const;
    void read(std::string_view key, glm::dvec3& value) const;
    void read(std::string_view key, std::array<double, 3>& value) const;
    void read(std::string_view key, std::array<int, 2>& value) const;
    template <class Enum>
    void read_choice(std::string_view key, Enum& value) const {
        const int index = choice(key);
        if (index >= 0) value = static_cast<Enum>(index);
    }

private:
    [[nodiscard]] int choice(std::string_view key) const;
    void check_missing() const;

    SceneReader& reader_;
    const BlockSpec& spec_;
    NodeId node_;
    std::vector<NodeId> values_;  ///< by index in the table
    NodeId misspelt_ = no_node;   ///< the first unknown key that resembles a known one,
    std::string_view meant_ = {}; ///< and that one
};

/// The table among `specs` that the object's `type` names; fails where there is none.
[[nodiscard]] const BlockSpec& spec_by_type(const SceneReader& reader, NodeId node, std::span<const BlockSpec> specs);

} // namespace lanecast
