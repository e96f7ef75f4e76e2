// Temporal antialiasing under light that changes, on a surface at rest.
#include "pass/temporal_harness.h"

#include "effects/jitter.h"
#include "support/device_fixture.h"

namespace reflet::test::temporal_light_test {
namespace {

constexpr uvec2 size{64, 48};
constexpr int restingFrames = 40;

using Light = std::function<float(vec2 at, int frame)>;  // frame: from the first that is not at rest; before: -1

vec3 textureAt(vec2 at) {
    const uvec2 field(at / 5.3F);
    return (field.x + field.y) % 2 == 0 ? vec3(0.8F, 0.7F, 0.6F) : vec3(0.1F, 0.12F, 0.1F);
}

vec3 truthAt(uvec2 pixel, const Light& light, int frame) {
    constexpr int side = 8;
    vec3 sum(0.0F);
    for (int i = 0; i < side * side; ++i) {
        const vec2 at = vec2(pixel) + (vec2(i % side, i / side) + 0.5F) / float(side);
        sum += textureAt(at) * light(at, frame);
    }
    return sum / float(side * side);
}

double relativeError(const vec3& v, const vec3& truth) {
    const vec3 off = v - truth;
    return double(glm::dot(off, off)) / (double(glm::dot(truth, truth)) + 0.01);
}

class TemporalLight : public DeviceTest {
protected:
    // Relative MSE in columns [from, to) after `frames` frames of other light, relative to that of the last one alone.
    static double error(float scale, const Light& light, int frames, uint32_t from = 0, uint32_t to = size.x) {
        const std::vector<vec4> all = pictureAfter(scale, light, -restingFrames, frames);
        const std::vector<vec4> alone = pictureAfter(scale, light, frames - 1, frames);
        double sum = 0.0;
        double sumAlone = 0.0;
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = from; x < to; ++x) {
                const vec3 truth = truthAt({x, y}, light, frames - 1);
                sum += relativeError(vec3(all[y * size.x + x]), truth);
                sumAlone += relativeError(vec3(alone[y * size.x + x]), truth);
            }
        }
        return sum / sumAlone;
    }

private:
    static std::vector<vec4> pictureAfter(float scale, const Light& light, int first, int end) {
        TemporalRun run(device(), uvec2(glm::round(vec2(size) * scale)), size);
        std::vector<vec4> last;
        for (int i = first; i < end; ++i) {
            const vec2 jitter = subpixelJitter(run.count());
            last = run.add([&](uvec2 p) {
                const vec2 at = (vec2(p) + 0.5F + jitter) / scale;
                const vec3 texture = textureAt(at);
                return MadeUpPixel{texture * light(at, std::max(i, -1)), vec2(0.0F), 0.5F, texture};
            });
        }
        return last;
    }
};

TEST_F(TemporalLight, ThatGetsBrighterKeepsTheTextureThatFramesAtRestHaveFound) {
    const Light light = [](vec2 at, int frame) { return 0.3F + 0.004F * at.x + 0.04F * float(frame + 1); };
    EXPECT_LT(error(0.5F, light, 8), 0.1);
    EXPECT_LT(error(1.0F, light, 8), 0.1);
}

TEST_F(TemporalLight, WhoseEdgeSweepsOverATextureLeavesNothingBehind) {
    const Light light = [](vec2 at, int frame) { return at.x < 14.0F + 3.0F * float(frame + 1) ? 1.0F : 0.15F; };
    // Lit for three frames and more.
    EXPECT_LT(error(0.5F, light, 12, 14, 41), 0.6);
    EXPECT_LT(error(1.0F, light, 12, 14, 41), 0.9);
}

TEST_F(TemporalLight, ThatGoesOnIsThereAtOnce) {
    const Light light = [](vec2 at, int frame) { return 0.1F + (frame >= 0 && at.y > 20.0F ? 1.0F : 0.0F); };
    EXPECT_LT(error(0.5F, light, 2), 1.1);
    EXPECT_LT(error(1.0F, light, 2), 1.1);
}

}  // namespace
}  // namespace reflet::test::temporal_light_test
