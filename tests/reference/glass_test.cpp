// Transmissive surfaces in the path tracer, against closed forms.
#include "reference/glass.h"

#include "reference/harness.h"

#include <cmath>

namespace reflet::test::glass_test {
namespace {

Material glass(float roughness, float thickness, float ior = 1.5F) {
    Material m = lambertMaterial(vec3(1.0F));
    m.roughness = roughness;
    m.ior = ior;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = thickness;
    return m;
}

View whiteView(const vec3& position, const vec3& target, float fovYDegrees) {
    View view = darkView(position, target, fovYDegrees);
    view.environment.radiance = vec3(1.0F);
    return view;
}

ReferencePicture trace(const Scene& scene, const View& view, uint32_t samples, uint32_t side = 8) {
    return traceReference(scene, view, {side, side}, {.samples = samples});
}

vec3 seenIn(const Scene& scene, const View& view, uint32_t samples) {
    return mean(trace(scene, view, samples).final);
}

TEST(Glass, AClearBallInAWhiteEnvironmentIsInvisible) {
    for (const float roughness : {0.0F, 0.1F, 0.3F, 0.6F, 1.0F}) {
        for (const float ior : {1.0F, 1.33F, 1.5F, 2.4F}) {
            Scene scene;
            add(scene, glass(roughness, 1.0F, ior), builtin::sphere(1.0F, 96));
            const ReferencePicture p = trace(scene, whiteView({0, 0, 4}, {0, 0, 0}, 26.0F), 256);
            EXPECT_NEAR(mean(p.final).x, 1.0F, 0.01F) << roughness << ", " << ior;
            EXPECT_NEAR(pixel(p.final, 4, 4), 1.0F, 0.1F) << roughness << ", " << ior;
            EXPECT_EQ(mean(p.indirectDiffuse), vec3(0.0F)) << "all light through glass is in the specular layer";
        }
    }
}

TEST(Glass, AClearPaneInAWhiteEnvironmentIsInvisible) {
    for (const float roughness : {0.0F, 0.3F, 1.0F}) {
        for (const float transmission : {0.4F, 1.0F}) {
            Scene scene;
            Material pane = glass(roughness, 0.0F);
            pane.transmission.factor = transmission;
            pane.doubleSided = true;
            add(scene, pane, square({0, 0, 0}, {0, 1, 0}, 10.0F));
            for (const float height : {1.0F, -1.0F}) {
                const ReferencePicture p = trace(scene, whiteView({0, height, 2}, {0, 0, 0}, 40.0F), 256);
                EXPECT_NEAR(mean(p.final).x, 1.0F, 0.006F) << roughness << ", " << transmission << ", " << height;
            }
        }
    }
}

// Metals, opaque shares and coats on glass neither add nor lose light.
TEST(Glass, MixedWithOtherLayersItReturnsAllLight) {
    for (const float metallic : {0.0F, 0.5F}) {
        for (const float coat : {0.0F, 1.0F}) {
            Scene scene;
            Material mixed = glass(0.2F, 1.0F);
            mixed.transmission.factor = 0.6F;
            mixed.metallic = metallic;
            mixed.clearcoat.factor = coat;
            mixed.clearcoat.roughness = 0.3F;
            add(scene, mixed, builtin::sphere(1.0F, 96));
            const ReferencePicture p = trace(scene, whiteView({0, 0, 4}, {0, 0, 0}, 20.0F), 512);
            EXPECT_NEAR(mean(p.final).x, 1.0F, 0.015F) << metallic << ", " << coat;
        }
    }
}

TEST(Glass, ANestedMediumIsInvisibleInAWhiteEnvironment) {
    Scene scene;
    add(scene, glass(0.0F, 1.0F, 1.5F), builtin::sphere(1.0F, 96));
    add(scene, glass(0.0F, 1.0F, 1.33F), builtin::sphere(0.8F, 64));
    add(scene, glass(0.0F, 1.0F, 1.1F), builtin::sphere(0.5F, 64), builtin::at({0.6F, 0, 0}));  // sticks out of it
    EXPECT_NEAR(seenIn(scene, whiteView({0, 0, 4}, {0, 0, 0}, 20.0F), 256).x, 1.0F, 0.01F);
}

// Straight through a slab without reflection: index 1, so Beer's law is all that is left.
TEST(Glass, ASlabAbsorbsByBeersLaw) {
    Scene scene;
    Material slab = glass(0.0F, 1.0F, 1.0F);
    slab.transmission.attenuationColor = {0.5F, 0.25F, 1.0F};
    slab.transmission.attenuationDistance = 0.4F;
    add(scene, slab, builtin::box({5, 5, 0.3F}));
    const vec3 got = seenIn(scene, whiteView({0, 0, 4}, {0, 0, 0}, 1.0F), 16);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(got[c], std::pow(slab.transmission.attenuationColor[c], 0.6F / 0.4F), 1e-3F) << c;
    }
}

TEST(Glass, TheBaseColourTintsEachBoundary) {
    const vec3 tint(0.5F, 0.8F, 1.0F);
    for (const float thickness : {0.0F, 1.0F}) {
        Scene scene;
        Material m = glass(0.0F, thickness, 1.0F);
        m.baseColor = vec4(tint, 1.0F);
        add(scene, m, thickness > 0.0F ? builtin::box({5, 5, 0.3F}) : square({0, 0, 0}, {0, 0, 1}, 5.0F));
        const vec3 got = seenIn(scene, whiteView({0, 0, 4}, {0, 0, 0}, 1.0F), 16);
        const vec3 expected = thickness > 0.0F ? tint * tint : tint;
        EXPECT_LT(glm::distance(got, expected), 1e-3F) << thickness;
    }
}

// Fraction of normally incident light that passes a slab of index n, with all reflections inside.
double slabTransmittance(double n) {
    const double r = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
    return (1.0 - r) / (1.0 + r);
}

TEST(Glass, ASlabLetsThroughWhatFresnelLeavesAtBothBoundaries) {
    for (const float ior : {1.33F, 1.5F, 2.4F}) {
        Scene scene;
        add(scene, glass(0.0F, 1.0F, ior), builtin::box({9, 9, 0.3F}));
        add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, 0, -2}, {0, 0, 1}, 9.0F));
        const vec3 got = seenIn(scene, darkView({0, 0, 4}, {0, 0, 0}, 1.0F), 4096);
        EXPECT_NEAR(got.x, slabTransmittance(ior), 0.006) << ior;
    }
}

// Where a ray that meets a slab of index n at 45 degrees hits the plane behind it: an edge between black and white
// there moves by the closed form.
TEST(Glass, ASlabShiftsWhatIsBehindBySnellsLaw) {
    constexpr float thickness = 0.5F;
    for (const float ior : {1.2F, 1.5F, 2.0F}) {
        const double inside = std::asin(std::sin(glm::radians(45.0)) / ior);
        const auto shift = static_cast<float>(thickness * (1.0 - std::tan(inside)));
        const auto brightness = [&](float edge) {  // of a wall that is white above `edge`, seen at 45 degrees
            Scene scene;
            Material slab = glass(0.0F, 1.0F, ior);
            slab.specular = 0.0F;  // no reflections
            add(scene, slab, builtin::box({50, 50, 0.5F * thickness}));
            add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, edge + 5.0F, -1}, {0, 0, 1}, 5.0F));
            View view = darkView({0, 4, 4}, {0, 0, 0}, 0.02F);
            return seenIn(scene, view, 16).x;
        };
        // Without glass the ray hits the plane z = -1 at y = -1.
        EXPECT_NEAR(brightness(-1.0F + shift - 0.01F), 1.0F, 1e-3F) << ior;
        EXPECT_NEAR(brightness(-1.0F + shift + 0.01F), 0.0F, 1e-3F) << ior;
    }
}

TEST(Glass, RefractionFollowsSnellAndEndsAtTheCriticalAngle) {
    const vec3 n(0, 0, 1);
    for (const float degrees : {0.0F, 20.0F, 41.0F, 42.0F, 70.0F}) {
        const float angle = glm::radians(degrees);
        const vec3 v(std::sin(angle), 0, std::cos(angle));
        const auto into = refracted(v, n, 1.5F);
        ASSERT_TRUE(into.has_value());
        EXPECT_NEAR(-into->x, v.x / 1.5F, 1e-6F);
        EXPECT_LT(into->z, 0.0F);
        const auto out = refracted(v, n, 1.0F / 1.5F);
        EXPECT_EQ(out.has_value(), degrees < 41.8F) << degrees;
        EXPECT_EQ(boundaryReflectance(v.z, 1.0F / 1.5F, 0.04F, 1.0F) == 1.0F, degrees > 41.8F) << degrees;
        if (out) {
            EXPECT_NEAR(-out->x, v.x * 1.5F, 1e-6F);
        }
    }
}

// Seen from within glass, through a boundary beyond the critical angle, the outside is not there.
TEST(Glass, TotalInternalReflectionShowsTheInside) {
    Scene scene;
    Material prism = glass(0.0F, 1.0F, 1.5F);
    prism.specular = 0.0F;  // no other reflections
    // A glass block seen through its front: rays at 45 degrees inside meet its floor beyond the critical angle.
    add(scene, prism, builtin::box({1, 1, 1}));
    add(scene, lambertMaterial(vec3(0.0F), vec3(1.0F)), square({0, -1.5F, 0}, {0, 1, 0}, 20.0F));  // glows below
    const double inside = glm::radians(30.0);  // 48.6 degrees outside; meets the floor at 60 from its normal
    const double outside = std::asin(1.5 * std::sin(inside));
    const vec3 hit(0, -0.5F, 1);
    const auto toward = vec3(0, std::sin(outside), std::cos(outside));
    const View view = darkView(hit + 3.0F * toward, hit, 0.5F);
    // It leaves through the back, toward a sky of black, still rising.
    EXPECT_NEAR(seenIn(scene, view, 16).x, 0.0F, 1e-3F);
    scene.materials[0].ior = 1.0F;
    EXPECT_NEAR(seenIn(scene, view, 16).x, 1.0F, 1e-3F);
}

// The lobe's pdf integrates to 1 over the sphere, and is the density of its samples.
TEST(Glass, ThePdfOfARoughBoundaryIsThatOfItsSamples) {
    const std::array<Boundary, 4> boundaries{
        Boundary{Boundary::Kind::outer, 1.0F, 1.5F}, Boundary{Boundary::Kind::inner, 1.5F, 1.0F},
        Boundary{Boundary::Kind::inner, 1.33F, 1.5F}, Boundary{Boundary::Kind::thin, 1.0F, 1.5F}};
    for (const Boundary& boundary : boundaries) {
        for (const float cosine : {0.95F, 0.5F}) {
            const vec3 view(std::sqrt(1.0F - cosine * cosine), 0, cosine);
            const GlassLobe lobe(boundary, view, 0.25F, 0.04F, 1.0F);
            constexpr int steps = 400;
            glm::dvec4 byPdf(0.0);
            glm::dvec4 bySamples(0.0);
            for (int i = 0; i < steps * steps; ++i) {
                const vec2 u = (vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps);
                const float z = 2.0F * u.x - 1.0F;
                const float r = std::sqrt(1.0F - z * z);
                const vec3 d(r * std::cos(2.0F * pi * u.y), r * std::sin(2.0F * pi * u.y), z);
                byPdf += glm::dvec4(d, 1.0) * (4.0 * pi * lobe.pdf(d) / (steps * steps));
                const float choice = std::fmod(static_cast<float>(i) * 0.6180340F, 1.0F);
                bySamples += glm::dvec4(lobe.sample(choice, u).direction, 1.0) / double(steps * steps);
            }
            for (int c = 0; c < 4; ++c) {
                EXPECT_NEAR(byPdf[c], bySamples[c], 0.012) << static_cast<int>(boundary.kind) << ", " << cosine;
            }
        }
    }
}

// Light of the sun passes straight: Fresnel, tint and absorption attenuate it, whatever the shape.
TEST(Glass, SunlightPassesStraightAndIsAttenuated) {
    const auto floorUnder = [](const std::optional<Material>& above) {
        Scene scene;
        add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 1.0F));
        if (above) {
            add(scene, *above, builtin::box({3, 0.25F, 3}), builtin::at({0, 3, 0}));
        }
        View view = darkView({0, 1, 0.01F}, {0, 0, 0}, 5.0F);
        view.sun.direction = vec3(0, -1, 0);
        view.sun.irradiance = vec3(2.0F);
        const ReferencePicture p = traceReference(scene, view, {4, 4}, {.bounces = 0, .samples = 16});
        return std::pair(mean(p.direct), mean(p.sunVisibility).x);
    };
    Material block = glass(0.0F, 1.0F);
    block.baseColor = {0.9F, 0.8F, 0.5F, 1.0F};
    block.transmission.attenuationColor = {0.5F, 1.0F, 1.0F};
    block.transmission.attenuationDistance = 1.0F;
    const vec3 open = floorUnder(std::nullopt).first;
    const auto [shaded, visibility] = floorUnder(block);
    const vec3 share = vec3(0.81F, 0.64F, 0.25F) * (0.96F * 0.96F) * vec3(std::sqrt(0.5F), 1, 1);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(shaded[c] / open[c], share[c], 1e-3F) << c;
    }
    EXPECT_NEAR(visibility, 0.2126F * share.x + 0.7152F * share.y + 0.0722F * share.z, 1e-3F);
    EXPECT_EQ(floorUnder(lambertMaterial(vec3(1.0F))).first, vec3(0.0F));
}

// Going through glass is no bounce: with none, a wall behind a pane is seen in direct light.
TEST(Glass, APaneDoesNotUseUpBounces) {
    for (const float roughness : {0.0F, 0.2F}) {
        const auto wall = [&](bool pane, uint32_t bounces) {
            Scene scene;
            add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 0, 1}, 9.0F));
            if (pane) {
                Material m = glass(roughness, 0.0F, 1.0F);
                m.doubleSided = true;
                add(scene, m, square({0, 0, 1}, {0, 0, 1}, 9.0F));
            }
            View view = whiteView({0, 0, 4}, {0, 0, 0}, 5.0F);
            view.sun.direction = vec3(0, 0, -1);
            view.sun.irradiance = vec3(2.0F);
            return mean(traceReference(scene, view, {4, 4}, {.bounces = bounces, .samples = 256}).final).x;
        };
        for (const uint32_t bounces : {0U, 1U}) {
            const float open = wall(false, bounces);
            EXPECT_GT(open, 0.3F);
            EXPECT_NEAR(wall(true, bounces), open, 0.02F * open) << roughness << ", " << bounces;
        }
    }
}

// Emitters behind a pane are found by scattered rays alone, so none of their light is counted twice.
TEST(Glass, ALampUnderClearGlassOfIndexOneShinesAsWithoutIt) {
    const auto under = [](bool pane) {
        Scene scene;
        add(scene, lambertMaterial(vec3(0.5F)), square({0, 0, 0}, {0, 1, 0}, 1.0F));
        add(scene, lambertMaterial(vec3(0), vec3(10)), square({0, 1, 0}, {0, -1, 0}, 0.5F));
        if (pane) {
            add(scene, glass(0.0F, 0.0F, 1.0F), square({0, 0.5F, 0}, {0, 1, 0}, 2.0F));
        }
        return mean(trace(scene, darkView({0, 0.4F, 3}, {0, 0, 0}, 3), 2048, 4).final).x;
    };
    const float open = under(false);
    EXPECT_NEAR(under(true), open, 0.015F * open);
}

}  // namespace
}  // namespace reflet::test::glass_test
