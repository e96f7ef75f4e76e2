// Images of values that were not rendered by a device: the layers of the reference.
#include "capture/show.h"

#include <gtest/gtest.h>

namespace reflet::test::show_test {
namespace {

TEST(ShowPicture, NeedsNoDeviceForTheLayersOfTheReference) {
    for (const char* name :
         {"direct", "indirect_diffuse", "indirect_specular", "albedo", "normal", "depth", "sun_visibility"}) {
        const Show& show = findShow(name);
        ASSERT_NE(show.picture, nullptr) << name;
        FloatImage values{2, 1, show.channels, {}};
        values.data.assign(show.channels.size(), 0.0F);
        values.data.resize(2 * show.channels.size(), 1.0F);
        const Bitmap bitmap = makePicture(show, values);
        EXPECT_EQ(bitmap.channels, 3U);
        ASSERT_EQ(bitmap.data.size(), 6U) << name;
        EXPECT_LT(bitmap.data[0], bitmap.data[3]) << name;
    }
}

}  // namespace
}  // namespace reflet::test::show_test
