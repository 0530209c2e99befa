#include "scene/error.hpp"
#include "scene/mesh_file.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <unistd.h>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

Mesh obj(const std::string& text, const Material& base = {}) {
    MeshWarnings warnings{.strict = true};
    return read_obj(text, "m.obj", {}, base, warnings);
}

/// Appends the bytes of a value in the byte order asked for.
template <class T>
void put(std::string& out, T value, bool big) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big) std::reverse(bytes, bytes + sizeof(T));
    out.append(bytes, sizeof(T));
}

} // namespace

TEST_CASE("OBJ: polygons, negative indices and every form of a corner") {
    const Mesh mesh = obj("# five vertices\r\nv 0 0 0\r\nv 1 0 0 1.0\nv  1 1 0 0.5 0.5 0.5\n\tv 0 1 0\nvt 0 0\nvn 0 0 1\n\n"
                          "f 1 2 3 4\nv 0.5 +2 -1e-1\nf 1/1 2/1 3/1 # comment\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -1 -2 "
                          "-5\nf 3 \\\n 4 \\\r\n 5");
    CHECK(mesh.positions.size() == 5);
    CHECK(mesh.positions[4] == glm::dvec3(0.5, 2, -0.1));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {4, 3, 0}, {2, 3, 4}});
    CHECK(mesh.materials.empty());
    CHECK(mesh.triangle_material.empty());
}

TEST_CASE("OBJ: a face may come before its vertices") {
    CHECK(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles.size() == 1);
    CHECK_THROWS_AS((void)obj("f 1 2 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), Error);
}

TEST_CASE("OBJ: materials") {
    const auto directory = std::filesystem::temp_directory_path() / ("lanecast_mtl_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory);
    std::ofstream(directory / "two words.mtl") << "newmtl red\nKd 1 0 0\n  Ns 10 # shiny\nillum 2\nmap_Kd wood.png\r\nnewmtl "
                                                  "grey glass\r\nKd 0.5\nKs 0.1 0.2 0.3\nKa 0 0 1\n";
    Material base;
    base.ambient = {0.25, 0.25, 0.25};
    base.reflective = {0.5, 0.5, 0.5};
    base.shininess = 3;
    MeshWarnings warnings;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const Mesh mesh = read_obj(vertices + "f 1 2 3\nmtllib two words.mtl\nusemtl red\nf 1 2 3\nmtllib two words.mtl\nusemtl grey "
                                          "glass\nf 1 2 3\nf 3 2 1\nusemtl none\nf 1 2 3\n",
                               "m.obj", directory, base, warnings);
    REQUIRE(mesh.materials.size() == 3);
    CHECK(mesh.triangle_material == std::vector<std::uint32_t>{0, 1, 2, 2, 0});
    CHECK(mesh.materials[0].ambient == base.ambient);
    CHECK(mesh.materials[1].diffuse == glm::dvec3(1, 0, 0));
    CHECK(mesh.materials[1].ambient == base.ambient);       // not in the MTL: the object's own
    CHECK(mesh.materials[1].reflective == base.reflective); // never in an MTL
    CHECK(mesh.materials[1].shininess == 10);
    CHECK(mesh.materials[2].diffuse == glm::dvec3(0.5));
    CHECK(mesh.materials[2].specular == glm::dvec3(0.1, 0.2, 0.3));
    CHECK(mesh.materials[2].ambient == glm::dvec3(0, 0, 1));
    CHECK(mesh.materials[2].shininess == 3);
    REQUIRE(warnings.messages.size() == 1);
    CHECK(warnings.messages[0] ==
          "m.obj:12:8: warning: the material `none` is not defined; the object's own is used\nusemtl none\n       ^");
    std::filesystem::remove_all(directory);
}

TEST_CASE("OBJ: a missing material library is a warning, and its materials are not missed again") {
    MeshWarnings warnings;
    const Mesh mesh =
        read_obj("mtllib no_such.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n", "m.obj", "/", {}, warnings);
    CHECK(mesh.triangles.size() == 1);
    CHECK(mesh.materials.empty());
    REQUIRE(warnings.messages.size() == 1);
    CHECK(warnings.messages[0].starts_with(
        "m.obj:1:8: warning: cannot read the materials `no_such.mtl`: No such file or directory\n"));
    warnings.strict = true;
    CHECK_THROWS_AS((void)read_obj("mtllib no_such.mtl\n", "m.obj", "/", {}, warnings), Error);
}

TEST_CASE("OBJ: unknown statements are warnings") {
    MeshWarnings warnings;
    (void)read_obj("g group\no object\ns off\nl 1 2\nvertex 1 2 3\n", "m.obj", {}, {}, warnings);
    REQUIRE(warnings.messages.size() == 1);
    CHECK(warnings.messages[0].starts_with("m.obj:5:1: warning: unknown statement `vertex`\n"));
    std::string many;
    for (int i = 0; i < 17; ++i) many += "vertex 1 2 3\n";
    warnings = {};
    (void)read_obj(many, "m.obj", {}, {}, warnings);
    CHECK(warnings.messages.size() == 10);
    CHECK(warnings.dropped == 7);
}

TEST_CASE("PLY: ASCII with other elements and properties in any order") {
    const Mesh mesh = read_ply("ply\r\nformat ascii 1.0\r\ncomment made by hand\nobj_info x\nelement camera 1\nproperty float "
                               "fov\nelement vertex 4\nproperty uchar red\n"
                               "property double y\nproperty list uchar float weights\nproperty float x\nproperty short "
                               "z\nelement face 2\nproperty list uchar uchar colour\n"
                               "property list int uint vertex_index\nproperty float area\nend_header\n60\n255 0.5 2 1 2 1 -1\n0 "
                               "0 0 1 0\n1 1 1 9 0 0\n2 3 0 4 5\n"
                               "0 4 0 1 2 3 0.5\n2 7 8 3 3 2 1 1e-3",
                               "m.ply");
    CHECK(mesh.positions == std::vector<glm::dvec3>{{1, 0.5, -1}, {1, 0, 0}, {0, 1, 0}, {4, 3, 5}});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}});
}

TEST_CASE("PLY: binary, both byte orders, every type of list") {
    for (const bool big : {false, true}) {
        for (const auto& [type, size] : {std::pair("char", 1),
                                         {"uchar", 1},
                                         {"short", 2},
                                         {"ushort", 2},
                                         {"int", 4},
                                         {"uint", 4},
                                         {"int8", 1},
                                         {"uint16", 2},
                                         {"int32", 4}}) {
            CAPTURE(big);
            CAPTURE(type);
            std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                                "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\n"
                                "property int z\nproperty short extra\nelement face 3\nproperty list " +
                                type + " " + type +
                                " vertex_indices\n"
                                "element edge 1\nproperty int a\nend_header\n";
            for (int i = 0; i < 4; ++i) {
                put(bytes, 0.1 * i, big);
                put(bytes, 0.5f * static_cast<float>(i), big);
                put(bytes, -i, big);
                put(bytes, static_cast<std::int16_t>(7), big);
            }
            const auto whole = [&, bytes_of_type = size](int value) {
                if (bytes_of_type == 1) put(bytes, static_cast<std::int8_t>(value), big);
                if (bytes_of_type == 2) put(bytes, static_cast<std::int16_t>(value), big);
                if (bytes_of_type == 4) put(bytes, static_cast<std::int32_t>(value), big);
            };
            for (const int value : {3, 0, 1, 2, 4, 0, 1, 2, 3, 3, 3, 2, 1}) whole(value);
            put(bytes, 99, big);
            const Mesh mesh = read_ply(bytes, "m.ply");
            for (int i = 0; i < 4; ++i) CHECK(mesh.positions[static_cast<std::size_t>(i)] == glm::dvec3(0.1 * i, 0.5 * i, -i));
            CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {3, 2, 1}});
            // Cut anywhere, it is an error.
            for (std::size_t cut = 0; cut + 4 < bytes.size(); ++cut)
                CHECK_THROWS_AS((void)read_ply(std::string_view(bytes).substr(0, cut), "m.ply"), Error);
        }
    }
}

TEST_CASE("the format is told by the extension, in any case") {
    CHECK(mesh_format("a/b.OBJ") == MeshFormat::obj);
    CHECK(mesh_format("c.Ply") == MeshFormat::ply);
    CHECK(mesh_format("c.stl") == MeshFormat::unknown);
    CHECK(mesh_format("obj") == MeshFormat::unknown);
}
