#include "render/deflate.hpp"

#include <new>

#include <libdeflate.h>

namespace lanecast {

Deflater::Deflater(int level) : compressor_(libdeflate_alloc_compressor(level)) {
    if (!compressor_) throw std::bad_alloc();
}

std::size_t Deflater::bound(std::size_t size) const noexcept { return libdeflate_zlib_compress_bound(compressor_.get(), size); }

std::size_t Deflater::compress(const void* data, std::size_t size, void* out, std::size_t room) noexcept {
    return libdeflate_zlib_compress(compressor_.get(), data, size, out, room);
}

void Deflater::Free::operator()(libdeflate_compressor* compressor) const noexcept { libdeflate_free_compressor(compressor); }

} // namespace lanecast
