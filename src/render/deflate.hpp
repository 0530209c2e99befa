#pragma once
// Data as a zlib stream (RFC 1950), by libdeflate: docs/output.md says what it takes beside zlib itself.

#include <cstddef>
#include <memory>

struct libdeflate_compressor;

namespace lanecast {

/// For one thread at a time; making one costs what compressing some kilobytes does. Equal data and levels give equal bytes.
class Deflater {
public:
    /// `level`: 1, fast, to 12, small. Throws std::bad_alloc.
    explicit Deflater(int level);

    /// As many bytes as `size` bytes may become.
    [[nodiscard]] std::size_t bound(std::size_t size) const noexcept;

    /// How many bytes it took; 0 if they would be more than `room`.
    [[nodiscard]] std::size_t compress(const void* data, std::size_t size, void* out, std::size_t room) noexcept;

private:
    struct Free {
        void operator()(libdeflate_compressor* compressor) const noexcept;
    };
    std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

} // namespace lanecast
