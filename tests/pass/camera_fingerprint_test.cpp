// Fingerprints of views: every field of a camera counts, and those of a lens only if there is one.
#include "job/fingerprint.h"
#include "scene/camera_fields.h"

#include <gtest/gtest.h>

namespace reflet::test::camera_fingerprint_test {
namespace {

std::string printOf(const Camera& camera) {
    View view;
    view.camera = camera;
    Fingerprint print;
    addTo(print, view);
    return print.text();
}

TEST(CameraFingerprint, DependsOnEveryField) {
    Camera camera;
    camera.apertureRadius = 0.1F;
    for (const CameraField& field : cameraFields()) {
        Camera other = camera;
        std::visit([&](const auto member) { other.*member += 1; }, field.member);
        EXPECT_NE(printOf(other), printOf(camera)) << field.key;
    }
    Camera other = camera;
    other.focus.push_back({.kind = FocusTarget::Kind::node, .node = "box"});
    EXPECT_NE(printOf(other), printOf(camera));
}

// The hash of a pinhole's values alone, which references of earlier versions were stored under.
TEST(CameraFingerprint, OfAPinholeIgnoresTheLens) {
    Camera other;
    other.blades = 5;
    other.focusDistance = 3.0F;
    other.focus.resize(1);
    EXPECT_EQ(printOf(other), printOf(Camera{}));
}

}  // namespace
}  // namespace reflet::test::camera_fingerprint_test
