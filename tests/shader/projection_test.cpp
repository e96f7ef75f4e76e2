// projection.glsl with the matrices that the renderer gives it.
#include "shader/projection_test.h"

#include "renderer/renderer.h"
#include "shader/directions.h"
#include "shader/harness.h"

namespace reflet::test::projection_test {
namespace {

constexpr uvec2 pixels{1920, 1080};

Camera obliqueCamera() {
    Camera camera;
    camera.position = {3, 4, -2};
    camera.target = {-1, 0.5F, 6};
    return camera;
}

Camera orthographicCamera() {
    Camera camera = obliqueCamera();
    camera.orthographicHeight = 12.0F;
    camera.near = 0.5F;
    camera.far = 300.0F;
    return camera;
}

struct Placed {
    vec3 p;
    glm::dvec2 uv;
    double distance;
};

/// World points at even steps over the screen and at the given distances, placed in double precision.
std::vector<Placed> placePoints(const Camera& camera, const std::vector<double>& distances) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const bool orthographic = camera.orthographicHeight > 0.0F;
    const double aspect = static_cast<double>(pixels.x) / pixels.y;
    std::vector<Placed> points;
    for (const double distance : distances) {
        const double halfHeight = orthographic ? 0.5 * camera.orthographicHeight
                                               : distance * std::tan(0.5 * static_cast<double>(camera.fovY));
        for (int i = 0; i <= 16; ++i) {
            for (int j = 0; j <= 16; ++j) {
                const glm::dvec2 uv(i / 16.0, j / 16.0);
                const glm::dvec2 at = (2.0 * uv - 1.0) * halfHeight;
                points.push_back(
                    {vec3(glm::dvec3(camera.position) + forward * distance + right * (at.x * aspect) - up * at.y), uv,
                     distance});
            }
        }
    }
    return points;
}

class Projection : public ShaderTest {
protected:
    /// Error allowed for a point: eight roundings of the largest number that goes into it [m].
    static double roundingOf(const Camera& camera, const Placed& point) {
        const double largest = glm::length(glm::dvec3(camera.position)) + glm::length(glm::dvec3(point.p)) +
                               (camera.orthographicHeight > 0.0F ? camera.far : 0.0F);
        return 8.0 * 6e-8 * largest;
    }

    static void expectRoundTrip(const Camera& camera, const std::vector<double>& distances) {
        const std::vector<Placed> points = placePoints(camera, distances);
        std::vector<vec3> inputs;
        inputs.reserve(points.size());
        for (const Placed& point : points) {
            inputs.push_back(point.p);
        }
        const ViewParams view = makeViewParams(camera, pixels, 0, 0);
        const auto projected = mapOnDevice<ProjectedPoint>("projection_test.comp", inputs, view);
        for (size_t i = 0; i < points.size(); ++i) {
            const double tolerance = roundingOf(camera, points[i]);
            const double span = camera.orthographicHeight > 0.0F ? camera.orthographicHeight : points[i].distance;
            ASSERT_NEAR(projected[i].uv.x, points[i].uv.x, tolerance / span) << points[i].distance;
            ASSERT_NEAR(projected[i].uv.y, points[i].uv.y, tolerance / span) << points[i].distance;
            ASSERT_NEAR(projected[i].distance, points[i].distance, tolerance);
            const double height = glm::dot(glm::dvec3(planeNormal), glm::dvec3(points[i].p) - glm::dvec3(planePoint));
            const double distance = camera.orthographicHeight > 0.0F ? 1.0 : points[i].distance;
            // Depth is off by as much, as a part, as the distance: so is the height.
            ASSERT_NEAR(projected[i].above * distance, height, 2.0 * tolerance * (1.0 + std::abs(height) / distance));
            ASSERT_LT(glm::distance(glm::dvec3(projected[i].back), glm::dvec3(points[i].p)), 2.0 * tolerance);
        }
    }
};

TEST_F(Projection, takesPerspectivePointsToTheScreenAndBack) {
    expectRoundTrip(obliqueCamera(), {0.05, 0.06, 0.1, 0.5, 1.0, 10.0, 300.0, 1e4, 1e6});
}

TEST_F(Projection, takesOrthographicPointsToTheScreenAndBack) {
    expectRoundTrip(orthographicCamera(), {0.5, 0.6, 1.0, 10.0, 150.0, 299.0});
}

TEST_F(Projection, takesPointsOfAWideViewWithATinyNearPlaneToTheScreenAndBack) {
    Camera camera = obliqueCamera();
    camera.fovY = glm::radians(120.0F);
    camera.near = 1e-3F;
    expectRoundTrip(camera, {0.01, 0.3, 20.0, 5e4});
}

TEST_F(Projection, putsPerspectiveSkyOutOfReach) {
    const ViewParams view = makeViewParams(obliqueCamera(), pixels, 0, 0);
    const auto distances = mapOnDevice<float>("depth_distance_test.comp", std::vector<float>{0.0F, 1.0F, 0.5F}, view);
    EXPECT_GT(distances[0], 1e15F);
    EXPECT_FALSE(std::isinf(distances[0]));
    EXPECT_FLOAT_EQ(distances[1], 0.05F);
    EXPECT_FLOAT_EQ(distances[2], 0.1F);
}

TEST_F(Projection, putsOrthographicDepthEvenlyBetweenNearAndFar) {
    const ViewParams view = makeViewParams(orthographicCamera(), pixels, 0, 0);
    const auto distances = mapOnDevice<float>("depth_distance_test.comp", std::vector<float>{0.0F, 1.0F, 0.5F}, view);
    EXPECT_FLOAT_EQ(distances[0], 300.0F);
    EXPECT_FLOAT_EQ(distances[1], 0.5F);
    EXPECT_FLOAT_EQ(distances[2], 150.25F);
}

TEST_F(Projection, pointsFromASurfaceToThePerspectiveEye) {
    const Camera camera = obliqueCamera();
    std::vector<vec3> points = spreadDirections(2000);
    for (size_t i = 0; i < points.size(); ++i) {
        points[i] = camera.position + points[i] * std::exp2(static_cast<float>(i % 20) - 4.0F);
    }
    const ViewParams view = makeViewParams(camera, pixels, 0, 0);
    const auto projected = mapOnDevice<ProjectedPoint>("projection_test.comp", points, view);
    for (size_t i = 0; i < points.size(); ++i) {
        const vec3 expected(glm::dvec3(camera.position) - glm::dvec3(points[i]));
        ASSERT_LT(angleBetween(projected[i].toEye, expected),
                  5e-7);  // the difference is exact to a rounding, so is this
        ASSERT_NEAR(glm::length(projected[i].toEye), 1.0F, 5e-7F);
    }
}

TEST_F(Projection, pointsFromEverySurfaceTheSameWayToTheOrthographicEye) {
    const Camera camera = orthographicCamera();
    const ViewParams view = makeViewParams(camera, pixels, 0, 0);
    const auto projected = mapOnDevice<ProjectedPoint>("projection_test.comp", spreadDirections(500), view);
    for (const ProjectedPoint& p : projected) {
        ASSERT_LT(angleBetween(p.toEye, camera.position - camera.target), 5e-7);
    }
}

}  // namespace
}  // namespace reflet::test::projection_test
