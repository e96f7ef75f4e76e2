// Sheen, anisotropic reflection and dispersion in the path tracer, against closed forms.
#include "reference/sheen_lobe.h"

#include "reference/glass.h"
#include "reference/harness.h"
#include "reference/specular_lobe.h"

#include <cmath>

namespace reflet::test::sheen_test {
namespace {

constexpr vec3 up(0, 1, 0);

// Toward the origin, in a white environment.
ReferencePicture inWhite(const Scene& scene, const vec3& position, float fovYDegrees, uint32_t samples) {
    View view = darkView(position, {0, 0, 0}, fovYDegrees);
    view.environment.radiance = vec3(1.0F);
    return traceReference(scene, view, {8, 8}, {.samples = samples});
}

Material sheenOn(const vec3& base, const vec3& color, float roughness) {
    Material m = lambertMaterial(base);
    m.specular = 0.0F;
    m.roughness = 1.0F;
    m.sheen.color = color;
    m.sheen.roughness = roughness;
    return m;
}

TEST(Sheen, ReturnsAllLightOfAWhiteBase) {
    for (const float roughness : {0.1F, 0.5F, 1.0F}) {
        for (const float metallic : {0.0F, 1.0F}) {
            Scene scene;
            Material m = sheenOn(vec3(1.0F), vec3(1.0F), roughness);
            m.metallic = metallic;
            add(scene, m, square({0, 0, 0}, up, 10.0F));
            const ReferencePicture p = inWhite(scene, {0, 1, 2}, 60.0F, 512);
            EXPECT_NEAR(mean(p.final).x, 1.0F, 0.01F) << roughness << ", " << metallic;
        }
    }
}

TEST(Sheen, OnBlackItReflectsItsAlbedoTimesItsColour) {
    const vec3 color(1.0F, 0.5F, 0.0F);
    for (const float roughness : {0.2F, 0.6F}) {
        for (const float degrees : {20.0F, 70.0F}) {
            Scene scene;
            add(scene, sheenOn(vec3(0.0F), color, roughness), square({0, 0, 0}, up, 10.0F));
            const float angle = glm::radians(degrees);
            const vec3 eye(0, 3.0F * std::cos(angle), 3.0F * std::sin(angle));
            const vec3 got = mean(inWhite(scene, eye, 0.5F, 1024).indirectDiffuse);
            const float albedo = sheenAlbedo(std::cos(angle), roughness);
            EXPECT_GT(albedo, 0.0F);
            EXPECT_LT(glm::distance(got, albedo * color), 0.03F * albedo + 2e-5F) << roughness << ", " << degrees;
        }
    }
}

// Light and eye at 60 degrees on opposite sides of the normal: the half vector is the normal, where no fibre stands. On
// the same side it is tilted by 60 degrees; Lambda there is exp(L(0.5)).
TEST(Sheen, IsTheClosedFormOfThePaper) {
    const float alpha = 0.25F;
    const mat3 frame(1.0F);
    const vec3 v(std::sqrt(0.75F), 0.0F, 0.5F);
    const SheenLobe lobe(frame, v, vec3(1.0F), std::sqrt(alpha));
    EXPECT_NEAR(lobe.reflect({-v.x, 0, v.z}).x, 0.0F, 1e-6F);
    const double t = 0.75 * 0.75;
    const auto mixed = [&](double rough, double smooth) { return rough + t * (smooth - rough); };
    const double curve =
        mixed(21.5473, 25.3245) / (1.0 + mixed(3.82987, 3.32435) * std::pow(0.5, mixed(0.19823, 0.16801))) +
        mixed(-1.97760, -1.27393) * 0.5 + mixed(-4.32054, -4.85967);
    const double density = (2.0 + 4.0) * std::pow(std::sqrt(0.75), 4.0) / (2.0 * glm::pi<double>());
    const double expected = density / ((1.0 + 2.0 * std::exp(curve)) * 4.0 * 0.25) * 0.5;
    EXPECT_NEAR(lobe.reflect(v).x, expected, 1e-4 * expected);
}

Material brushed(float strength, float rotation) {
    Material m = lambertMaterial(vec3(1.0F));
    m.metallic = 1.0F;
    m.roughness = 0.3F;
    m.anisotropy.strength = strength;
    m.anisotropy.rotation = rotation;
    return m;
}

TEST(Anisotropy, ReturnsAboutAllLightOfAWhiteMetal) {
    for (const float strength : {0.0F, 0.3F, 0.7F, 1.0F}) {
        Scene scene;
        add(scene, brushed(strength, 0.5F), square({0, 0, 0}, up, 10.0F));
        const ReferencePicture p = inWhite(scene, {0, 1, 2}, 60.0F, 512);
        // The compensation for lost energy is that of an isotropic lobe.
        EXPECT_NEAR(mean(p.final).x, 1.0F, strength > 0.0F ? 0.06F : 0.006F) << strength;
    }
}

// Seen from above, the highlight of the sun beside the zenith is stretched along the direction: GGX's closed form.
TEST(Anisotropy, StretchesTheHighlightAlongItsDirection) {
    constexpr float strength = 0.8F;
    const float tilt = glm::radians(10.0F);  // of the half vector
    const auto reflected = [&](float rotation, float azimuth) {
        Scene scene;
        add(scene, brushed(strength, rotation), square({0, 0, 0}, up, 10.0F));
        const vec3 tangent = vec3(scene.meshes.back().attributes.front().tangent);
        const vec3 bitangent = glm::cross(up, tangent) * scene.meshes.back().attributes.front().tangent.w;
        View view = darkView({0, 4, 0}, {0, 0, 0}, 0.1F);
        view.camera.up = {0, 0, 1};
        const vec3 aside = tangent * std::cos(azimuth) + bitangent * std::sin(azimuth);
        view.sun.direction = -(up * std::cos(2.0F * tilt) + aside * std::sin(2.0F * tilt));
        view.sun.irradiance = vec3(1.0F);
        view.sun.angularDiameter = 0.0F;
        return double(mean(traceReference(scene, view, {2, 2}, {.bounces = 0, .samples = 16}).direct).x);
    };
    const auto density = [&](double along, double across) {
        const double ab = 0.09;
        const double at = ab + (1.0 - ab) * strength * strength;
        const double s = along * along / (at * at) + across * across / (ab * ab) + std::pow(std::cos(tilt), 2.0);
        return 1.0 / (glm::pi<double>() * at * ab * s * s);
    };
    const double sine = std::sin(tilt);
    const double ratio = density(sine, 0.0) / density(0.0, sine);
    for (const float rotation : {0.0F, 1.0F}) {
        const double along = reflected(rotation, rotation);
        const double across = reflected(rotation, rotation + 0.5F * pi);
        EXPECT_NEAR(along / across, ratio, 0.05 * ratio) << rotation;
        EXPECT_GT(along, 3.0 * across);
    }
}

TEST(Anisotropy, ThePdfOfTheLobeIsThatOfItsSamples) {
    const vec3 view = glm::normalize(vec3(0.5F, 0.3F, 0.6F));
    const SpecularLobe lobe(mat3(1.0F), view, {0.6F, 0.15F}, {vec3(1.0F), 1.0F}, vec3(1.0F), {1.0F, 0.0F});
    constexpr int steps = 600;
    glm::dvec4 byPdf(0.0);
    glm::dvec4 bySamples(0.0);
    for (int i = 0; i < steps * steps; ++i) {
        const vec2 u = (vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps);
        const float r = std::sqrt(1.0F - u.x * u.x);
        const vec3 d(r * std::cos(2.0F * pi * u.y), r * std::sin(2.0F * pi * u.y), u.x);
        byPdf += glm::dvec4(d, 1.0) * (2.0 * pi * lobe.pdf(d) / (steps * steps));
        const vec3 sample = lobe.sample(u);
        bySamples += lobe.above(sample) ? glm::dvec4(sample, 1.0) / double(steps * steps) : glm::dvec4(0.0);
    }
    for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(byPdf[c], bySamples[c], 0.005) << c;
    }
}

Material prism(float dispersion) {
    Material m = lambertMaterial(vec3(1.0F));
    m.roughness = 0.0F;
    m.ior = 1.5F;
    m.transmission = {.factor = 1.0F, .thickness = 1.0F, .dispersion = dispersion};
    return m;
}

TEST(Dispersion, RedAndBlueHaveIndicesByTheAbbeNumber) {
    const Medium flint{.ior = 1.6F, .dispersion = 20.0F / 30.0F};  // Abbe number 30
    EXPECT_NEAR((flint.iorOf(1) - 1.0F) / (flint.iorOf(2) - flint.iorOf(0)), 30.0F, 0.01F);
    EXPECT_EQ(flint.iorOf(1), 1.6F);
    EXPECT_EQ((Medium{.ior = 1.01F, .dispersion = 1000.0F}.iorOf(0)), 1.0F);
}

TEST(Dispersion, ABallInAWhiteEnvironmentIsWhite) {
    for (const float roughness : {0.0F, 0.3F}) {
        Scene scene;
        Material m = prism(2.0F);
        m.roughness = roughness;
        add(scene, m, builtin::sphere(1.0F, 96));
        const vec3 got = mean(inWhite(scene, {0, 0, 4}, 26.0F, 1024).final);
        EXPECT_LT(glm::distance(got, vec3(1.0F)), 0.03F) << roughness;
    }
}

// Behind a slab at 45 degrees each colour is shifted by Snell's law for its own index.
TEST(Dispersion, ASlabShiftsEachColourByItsIndex) {
    constexpr float thickness = 0.5F;
    constexpr float dispersion = 4.0F;
    const auto shift = [&](float ior) {
        return static_cast<float>(thickness * (1.0 - std::tan(std::asin(std::sin(glm::radians(45.0)) / ior))));
    };
    const auto seen = [&](float edge) {  // of a wall that is white above `edge`
        Scene scene;
        Material slab = prism(dispersion);
        slab.specular = 0.0F;  // no reflections
        add(scene, slab, builtin::box({50, 50, 0.5F * thickness}));
        add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, edge + 5.0F, -1}, {0, 0, 1}, 5.0F));
        return mean(traceReference(scene, darkView({0, 4, 4}, {0, 0, 0}, 0.02F), {8, 8}, {.samples = 256}).final);
    };
    const std::array<float, 3> iors{1.45F, 1.5F, 1.55F};
    for (int c = 0; c < 3; ++c) {
        const float edge = -1.0F + shift(iors[static_cast<size_t>(c)]);
        EXPECT_NEAR(seen(edge - 0.004F)[c], 1.0F, 0.06F) << c;
        EXPECT_NEAR(seen(edge + 0.004F)[c], 0.0F, 1e-3F) << c;
    }
    const vec3 between = seen(-1.0F + 0.5F * (shift(1.5F) + shift(1.55F)));
    EXPECT_NEAR(between.r, 0.0F, 1e-3F);
    EXPECT_NEAR(between.b, 1.0F, 0.06F);
}

}  // namespace
}  // namespace reflet::test::sheen_test
