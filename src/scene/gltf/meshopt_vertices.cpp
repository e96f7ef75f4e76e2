// The vertex codec of KHR_meshopt_compression in version 1, and its filter COLOR.
#include "scene/gltf/meshopt_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace reflet {

namespace {

constexpr size_t groupSize = 16;
constexpr size_t maxBlock = 256;
constexpr size_t maxStride = 256;
constexpr size_t minTail = 24;

/// Bytes of the stream in order; `failed` once more were asked for than there are.
class Reader {
public:
    explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    uint8_t next() { return take(1)[0]; }

    std::span<const uint8_t> take(size_t count) {
        static constexpr std::array<uint8_t, maxBlock> none{};
        if (count > bytes_.size()) {
            failed = true;
            return std::span(none).first(count);
        }
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }

    [[nodiscard]] bool ended() const { return !failed && bytes_.empty(); }

    bool failed = false;

private:
    std::span<const uint8_t> bytes_;
};

/// Sixteen values of 0, 1, 2, 4 or 8 bits. One with all bits set stands for a byte that follows.
void readGroup(Reader& from, unsigned bits, std::span<uint8_t> to) {
    if (bits == 0) {
        std::ranges::fill(to, uint8_t(0));
        return;
    }
    const auto packed = from.take(groupSize * bits / 8);
    const unsigned perByte = 8 / bits;
    const auto escape = static_cast<uint8_t>((1U << bits) - 1U);
    for (unsigned i = 0; i < groupSize; ++i) {
        const unsigned place = i % perByte;
        const unsigned shift = bits == 1 ? place : 8U - bits * (place + 1U);  // single bits start at the lowest
        const auto value = static_cast<uint8_t>((unsigned(packed[i / perByte]) >> shift) & escape);
        to[i] = bits < 8 && value == escape ? from.next() : value;
    }
}

/// The deltas of one byte of all elements of a block; `to` has whole groups.
void readDeltas(Reader& from, unsigned control, size_t elements, std::span<uint8_t> to) {
    constexpr std::array<std::array<unsigned, 4>, 2> bitsOf{{{0, 1, 2, 4}, {1, 2, 4, 8}}};
    if (control == 2) {
        std::ranges::fill(to, uint8_t(0));
    } else if (control == 3) {
        std::ranges::copy(from.take(elements), to.begin());
    } else {
        const size_t groups = to.size() / groupSize;
        const auto headers = from.take((groups + 3) / 4);
        for (size_t g = 0; g < groups; ++g) {
            const unsigned mode = (unsigned(headers[g / 4]) >> (2 * (g % 4))) & 3U;
            readGroup(from, bitsOf.at(control).at(mode), to.subspan(g * groupSize, groupSize));
        }
    }
}

template <class T>
T unzigzag(T v) {
    return static_cast<T>((v & 1U) != 0 ? ~(v >> 1U) : v >> 1U);
}

/// The next value of a channel of four bytes; nullopt: the mode is invalid.
std::optional<uint32_t> advanced(uint32_t last, uint32_t delta, uint8_t channel) {
    const unsigned mode = channel & 15U;
    const unsigned turn = channel >> 4U;
    uint32_t result = 0;
    if (mode == 0 && turn == 0) {
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const auto step = unzigzag(static_cast<uint8_t>(delta >> shift));
            result |= uint32_t(static_cast<uint8_t>((last >> shift) + step)) << shift;
        }
        return result;
    }
    if (mode == 1 && turn == 0) {
        for (unsigned shift = 0; shift < 32; shift += 16) {
            const auto step = unzigzag(static_cast<uint16_t>(delta >> shift));
            result |= uint32_t(static_cast<uint16_t>((last >> shift) + step)) << shift;
        }
        return result;
    }
    return mode == 2 ? std::optional(last ^ std::rotl(delta, static_cast<int>(turn))) : std::nullopt;
}

uint32_t word(const uint8_t* bytes) {
    return uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8U | uint32_t(bytes[2]) << 16U | uint32_t(bytes[3]) << 24U;
}

/// One block of elements. `last`: the element before it, and then its last one.
bool readBlock(Reader& from, std::span<uint8_t> last, std::span<const uint8_t> channels, std::span<uint8_t> to) {
    const size_t stride = last.size();
    const size_t elements = to.size() / stride;
    const size_t padded = (elements + groupSize - 1) / groupSize * groupSize;
    const auto control = from.take(stride / 4);
    std::array<std::array<uint8_t, maxBlock>, 4> deltas;  // one channel's
    for (size_t c = 0; c < stride / 4; ++c) {
        for (size_t k = 0; k < 4; ++k) {
            readDeltas(from, (unsigned(control[c]) >> (2 * k)) & 3U, elements, std::span(deltas[k]).first(padded));
        }
        uint32_t value = word(&last[4 * c]);
        for (size_t i = 0; i < elements; ++i) {
            const std::array<uint8_t, 4> bytes{deltas[0][i], deltas[1][i], deltas[2][i], deltas[3][i]};
            const auto next = advanced(value, word(bytes.data()), channels[c]);
            if (!next || from.failed) {
                return false;
            }
            value = *next;
            for (unsigned k = 0; k < 4; ++k) {
                to[i * stride + 4 * c + k] = static_cast<uint8_t>(value >> (8 * k));
            }
        }
    }
    std::ranges::copy(to.last(stride), last.begin());
    return true;
}

template <class T>
void decodeColors(std::span<uint8_t> elements) {
    constexpr auto most = static_cast<float>(T(~T(0)));
    for (size_t i = 0; i + 4 * sizeof(T) <= elements.size(); i += 4 * sizeof(T)) {
        std::array<T, 4> in{};
        std::memcpy(in.data(), &elements[i], sizeof(in));
        const auto widest = static_cast<int>((1U << static_cast<unsigned>(std::bit_width(unsigned(in[3])))) - 1U);
        const int y = in[0];
        const int orange = static_cast<std::make_signed_t<T>>(in[1]);
        const int green = static_cast<std::make_signed_t<T>>(in[2]);
        const int alpha = in[3] & (widest >> 1);
        const std::array<int, 4> color{y + orange - green, y + green, y - orange - green, alpha << 1 | (alpha & 1)};
        std::array<T, 4> out{};
        for (size_t c = 0; c < 4; ++c) {
            const float value =
                std::round(static_cast<float>(color[c]) * most / static_cast<float>(std::max(widest, 1)));
            out[c] = static_cast<T>(std::clamp(value, 0.0F, most));
        }
        std::memcpy(&elements[i], out.data(), sizeof(out));
    }
}

}  // namespace

bool decodeMeshoptVertices(std::span<const uint8_t> stream, uint64_t stride, uint64_t count, std::span<uint8_t> to) {
    const size_t tail = std::max<size_t>(stride + stride / 4, minTail);
    if (stream.size() < 1 + tail || stream[0] != meshoptVertexHeader1 || stride > maxStride || stride % 4 != 0) {
        return false;
    }
    const auto ending = stream.last(stride + stride / 4);
    std::array<uint8_t, maxStride> first{};
    std::ranges::copy(ending.first(stride), first.begin());
    const std::span<uint8_t> last = std::span(first).first(stride);
    Reader reader(stream.subspan(1, stream.size() - 1 - tail));
    const uint64_t largest = std::min<uint64_t>((8192 / stride) & ~uint64_t(15), maxBlock);
    for (uint64_t done = 0; done < count;) {
        const uint64_t elements = std::min(count - done, largest);
        if (!readBlock(reader, last, ending.subspan(stride), to.subspan(done * stride, elements * stride))) {
            return false;
        }
        done += elements;
    }
    return reader.ended();
}

void decodeMeshoptColors(std::span<uint8_t> elements, uint64_t stride) {
    if (stride == 8) {
        decodeColors<uint16_t>(elements);
    } else {
        decodeColors<uint8_t>(elements);
    }
}

}  // namespace reflet
