// What the target of the C API reads from its bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace reflet::fuzz {

class ApiBytes {
public:
    ApiBytes(const uint8_t* bytes, size_t size) : next_(bytes), end_(bytes + size) {}

    [[nodiscard]] bool done() const { return next_ == end_; }
    /// 0 at the end.
    uint8_t byte() { return next_ == end_ ? uint8_t{0} : *next_++; }
    uint32_t below(uint32_t count) { return byte() % count; }
    /// True for the highest `of256` of 256 bytes.
    bool chance(uint32_t of256) { return byte() >= 256 - of256; }
    uint32_t bits() {
        const uint32_t low = byte() | uint32_t(byte()) << 8U;
        return low | uint32_t(byte()) << 16U | uint32_t(byte()) << 24U;
    }
    /// Small, a limit of something, or anything.
    uint32_t word() {
        constexpr std::array<uint32_t, 20> edges{0,     1,     2,          3,          4,          5,         16,
                                                 17,    63,    64,         255,        256,        257,       16384,
                                                 16385, 65535, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF};
        const uint32_t which = byte();
        return which < 80 ? which % 7 : which < 240 ? edges[which % edges.size()] : bits();
    }
    float real() {
        using Limits = std::numeric_limits<float>;
        constexpr std::array<float, 24> edges{0.0F,
                                              -0.0F,
                                              1.0F,
                                              -1.0F,
                                              0.5F,
                                              -0.5F,
                                              2.0F,
                                              1e-3F,
                                              1e-8F,
                                              1e-20F,
                                              1e-44F,
                                              1e8F,
                                              1e10F,
                                              65504.0F,
                                              65505.0F,
                                              1e20F,
                                              1e38F,
                                              -1e38F,
                                              3600.0F,
                                              1e6F,
                                              Limits::infinity(),
                                              -Limits::infinity(),
                                              Limits::quiet_NaN(),
                                              Limits::max()};
        const uint32_t which = byte();
        if (which < 220) {
            return edges[which % edges.size()];
        }
        const uint32_t raw = bits();
        float value = 0.0F;
        std::memcpy(&value, &raw, sizeof value);
        return value;
    }
    /// Without zeros.
    std::string text(size_t longest) {
        std::string result;
        for (size_t left = below(static_cast<uint32_t>(longest) + 1); left > 0; --left) {
            result.push_back(static_cast<char>(std::max<uint8_t>(byte(), 1)));
        }
        return result;
    }

private:
    const uint8_t* next_;
    const uint8_t* end_;
};

}  // namespace reflet::fuzz
