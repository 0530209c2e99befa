#pragma once
// libpng's errors: the reason is kept, and libpng left by longjmp to the setjmp of the caller.

#include <csetjmp>
#include <cstring>

#include <png.h>

namespace lanecast {

/// To be given to libpng with the two functions below.
struct PngReason {
    char text[128] = "unknown reason";
};

inline void keep_png_reason(png_structp png, png_const_charp message) {
    PngReason& reason = *static_cast<PngReason*>(png_get_error_ptr(png));
    std::strncpy(reason.text, message, sizeof reason.text - 1); // the message may lie on the stack that longjmp drops
    png_longjmp(png, 1);
}

inline void ignore_png_warning(png_structp, png_const_charp) {}

} // namespace lanecast
