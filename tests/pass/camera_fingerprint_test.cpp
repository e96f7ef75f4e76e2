// Fingerprints of views: every field of a camera counts.
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
    for (const CameraField& field : cameraFields()) {
        Camera other = camera;
        std::visit([&](const auto member) { other.*member += 1; }, field.member);
        EXPECT_NE(printOf(other), printOf(camera)) << field.key;
    }
    Camera other = camera;
    other.focus.push_back({.kind = FocusTarget::Kind::node, .node = "box"});
    EXPECT_NE(printOf(other), printOf(camera));
}

}  // namespace
}  // namespace reflet::test::camera_fingerprint_test
