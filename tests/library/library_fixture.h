// What tests of the C API share: a host, and views that draw its room.
#pragma once

#include "library/library_host.h"

#include "base/math.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/packing.hpp>
#include <glm/gtx/component_wise.hpp>

#include <cstring>
#include <vector>

namespace reflet::test {

template <class T>
std::vector<T> texelsOf(LibraryHost& host, const RefletImage& image) {
    const std::vector<std::byte> bytes = host.read(image, sizeof(T));
    std::vector<T> texels(bytes.size() / sizeof(T));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
}

inline std::vector<vec4> halvesOf(LibraryHost& host, const RefletImage& image) {
    std::vector<vec4> values;
    for (const uint64_t texel : texelsOf<uint64_t>(host, image)) {
        values.push_back(glm::unpackHalf4x16(texel));
    }
    return values;
}

class Library : public ::testing::Test {
protected:
    void TearDown() override {
        for (const std::string& message : host_.host.messages()) {
            ADD_FAILURE() << message;
        }
    }

    RefletView makeView(RefletContext context, uint32_t framesInFlight, uint32_t width = HostRoom::width,
                        uint32_t height = HostRoom::height) {
        RefletViewInfo info{sizeof info, width, height, framesInFlight, REFLET_VIEW_PASS_TIMES, 0};
        RefletView view = nullptr;
        EXPECT_REFLET(refletCreateView(context, &info, &view));
        return view;
    }
    static RefletSettings makeSettings(const char* preset) {
        RefletSettings settings = nullptr;
        EXPECT_REFLET(refletCreateSettings(preset, &settings));
        return settings;
    }
    RoomResults renderFrames(const HostRoom& room, RefletView view, RefletSettings settings, uint32_t count,
                             bool wait = false) {
        RoomResults results;
        for (uint32_t i = 0; i < count; ++i) {
            host_.host.frame(
                [&](VkCommandBuffer commands) { results = recordRoom(room, view, settings, commands, i); });
            if (wait) {
                host_.host.waitForAll();
            }
        }
        host_.host.waitForAll();
        return results;
    }

    LibraryHost host_;
};

}  // namespace reflet::test
