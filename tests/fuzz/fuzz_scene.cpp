// Any bytes as a scene: a description or an Error.

#include "scene/error.hpp"
#include "scene/load_scene.hpp"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const bool strict : {false, true}) {
        try {
            (void)lanecast::parse_scene(text, "fuzz.json", "/nonexistent", {.strict = strict});
        } catch (const lanecast::Error&) {
        }
    }
    return 0;
}
