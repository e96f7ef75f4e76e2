// Value noise: a hashed number at every lattice point, interpolated with a quintic for continuous slopes.
#include "scene/builtin/noise.h"

namespace reflet::builtin {
namespace {

vec3 quintic(const vec3& t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

uint32_t mixBits(uint32_t h) {
    h ^= h >> 15U;
    h *= 0x2C1B3C6DU;
    h ^= h >> 12U;
    h *= 0x297A2D39U;
    h ^= h >> 15U;
    return h;
}

}  // namespace

uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed) {
    const uint32_t lattice = 0x8DA6B343U * static_cast<uint32_t>(x) + 0xD8163841U * static_cast<uint32_t>(y) +
                             0xCB1AB31FU * static_cast<uint32_t>(z);
    return mixBits(lattice ^ (0x9E3779B9U * (seed + 1U)));
}

float hash01(int32_t x, int32_t y, int32_t z, uint32_t seed) {
    return static_cast<float>(hash(x, y, z, seed) >> 8U) * (1.0F / 16777216.0F);
}

float noise(const vec3& p, uint32_t seed) {
    const vec3 cell = glm::floor(p);
    const vec3 t = quintic(p - cell);
    const glm::ivec3 i(cell);
    const auto at = [&](int x, int y, int z) { return hash01(i.x + x, i.y + y, i.z + z, seed); };
    const float low = glm::mix(glm::mix(at(0, 0, 0), at(1, 0, 0), t.x), glm::mix(at(0, 1, 0), at(1, 1, 0), t.x), t.y);
    const float high = glm::mix(glm::mix(at(0, 0, 1), at(1, 0, 1), t.x), glm::mix(at(0, 1, 1), at(1, 1, 1), t.x), t.y);
    return 2.0F * glm::mix(low, high, t.z) - 1.0F;
}

float fractalNoise(const vec3& p, int octaves, uint32_t seed) {
    float sum = 0.0F;
    float strength = 0.5F;
    vec3 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += strength * noise(q, seed + static_cast<uint32_t>(i));
        q = 2.0F * q + vec3(17.3F, 5.7F, 11.1F);  // offset, so that the lattices do not coincide at the origin
        strength *= 0.5F;
    }
    return sum;
}

float tilingNoise(const vec2& uv, int cells, int octaves, uint32_t seed) {
    float sum = 0.0F;
    float strength = 0.5F;
    for (int octave = 0; octave < octaves; ++octave, cells *= 2, strength *= 0.5F) {
        const vec2 p = uv * static_cast<float>(cells);
        const vec2 cell = glm::floor(p);
        const vec3 t = quintic(vec3(p - cell, 0.0F));
        const auto at = [&](int x, int y) {
            const int column = (static_cast<int>(cell.x) + x) % cells;
            const int row = (static_cast<int>(cell.y) + y) % cells;
            return hash01(column, row, octave, seed);
        };
        const float value = glm::mix(glm::mix(at(0, 0), at(1, 0), t.x), glm::mix(at(0, 1), at(1, 1), t.x), t.y);
        sum += strength * (2.0F * value - 1.0F);
    }
    return sum;
}

}  // namespace reflet::builtin
