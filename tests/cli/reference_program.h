// Shared by the tests of `reflet reference`: images so small that a few samples suffice.
#pragma once

#include "cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet {

class Reference : public ProgramTest {
protected:
    using Names = std::vector<std::string>;
    using Images = std::map<std::string, FloatImage>;

    inline static const std::string cubes = "builtin:cubes";

    [[nodiscard]] static Arguments arguments(const std::string& scene, const Arguments& more) {
        Arguments all{"reference", scene, "--size", "32x18"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome reference(const std::string& scene, const Arguments& more) const {
        return run(arguments(scene, more));
    }
    /// The bytes of the EXR of the cubes.
    [[nodiscard]] std::string bytes(const Arguments& more) const {
        Arguments all{"--spp", "3", "-o", "bytes.exr"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(reference(cubes, all)));
        return read("bytes.exr");
    }
    /// The EXR's layers by name.
    [[nodiscard]] Images images(std::string_view file) const {
        Images result;
        for (ImageLayer& layer : layers(file)) {
            result.emplace(layer.name, std::move(layer.image));
        }
        return result;
    }
    [[nodiscard]] Images traced(const std::string& scene, const Arguments& more) const {
        Arguments all{"-o", "traced.exr"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(reference(scene, all)));
        return images("traced.exr");
    }
};

/// Maximum of all values of all channels.
inline float largest(const FloatImage& image) {
    return std::ranges::max(image.data);
}

}  // namespace reflet
