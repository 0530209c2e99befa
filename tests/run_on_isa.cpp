// run_on_isa <isa> <program> [arguments]: runs the program if this CPU has the instruction set, else says so and passes.

#include "render/dispatch.hpp"

#include <cstdio>
#include <string_view>

#include <unistd.h>

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    for (const lanecast::IsaInfo& isa : lanecast::known_isas()) {
        if (isa.name == argv[1] && isa.supported) {
            execv(argv[2], argv + 2);
            std::perror(argv[2]);
            return 1;
        }
    }
    std::printf("skipped: this CPU lacks %s\n", argv[1]);
    return 0;
}
