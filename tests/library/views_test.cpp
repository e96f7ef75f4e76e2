// Several views of a context, on several threads and in any order of destruction; contact shadows of any light.
#include "library/library_fixture.h"

#include <volk.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace reflet::test {
namespace {

class Views : public Library {
protected:
    Views() {
        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        vkCreateCommandPool(device(), &pool, nullptr, &pool_);
        VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocate.commandPool = pool_;
        allocate.level = VK_COMMAND_BUFFER_LEVEL_SECONDARY;
        allocate.commandBufferCount = 1;
        vkAllocateCommandBuffers(device(), &allocate, &second_);
    }
    ~Views() override {
        host_.host.waitForAll();
        vkDestroyCommandPool(device(), pool_, nullptr);
    }
    // Two command buffers, of pools of their own, that run one after the other.
    void frameOfTwo(const std::function<void(const std::array<VkCommandBuffer, 2>&)>& record) {
        host_.host.waitForAll();
        const VkCommandBufferInheritanceInfo inherited{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.pInheritanceInfo = &inherited;
        vkBeginCommandBuffer(second_, &begin);
        host_.host.frame([&](VkCommandBuffer first) {
            record({first, second_});
            vkEndCommandBuffer(second_);
            vkCmdExecuteCommands(first, 1, &second_);
        });
    }

private:
    [[nodiscard]] VkDevice device() const { return host_.host.device().device; }

    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer second_ = VK_NULL_HANDLE;
};

// Two eyes, each recorded by a thread of its own into a command buffer of its own, give what one thread records.
TEST_F(Views, RecordSideBySideOnThreads) {
    RefletContext context = host_.makeContext();
    const HostRoom room(host_, {});
    constexpr uint32_t frames = 6;
    std::vector<std::vector<vec4>> pictures;
    for (const bool threads : {false, true}) {
        std::array<RefletView, 2> views = {makeView(context, 3), makeView(context, 3)};
        std::array<RefletSettings, 2> settings = {makeSettings("balanced"), makeSettings("balanced")};
        std::array<RoomResults, 2> results;
        for (uint32_t i = 0; i < frames; ++i) {
            frameOfTwo([&](const std::array<VkCommandBuffer, 2>& commands) {
                const auto record = [&](size_t eye) {
                    results[eye] = recordRoom(room, views[eye], settings[eye], commands[eye], i);
                };
                if (threads) {
                    std::jthread other([&] { record(1); });
                    record(0);
                } else {
                    record(0);
                    record(1);
                }
            });
        }
        host_.host.waitForAll();
        for (size_t eye = 0; eye < 2; ++eye) {
            pictures.push_back(halvesOf(host_, results[eye].antialiased));
            refletDestroySettings(settings[eye]);
            refletDestroyView(views[eye]);
        }
    }
    for (size_t i = 1; i < pictures.size(); ++i) {
        EXPECT_EQ(pictures[i], pictures[0]) << i;
    }
    refletDestroyContext(context);
}

TEST_F(Views, OutliveTheirContextAndAreDestroyedOnce) {
    RefletContextInfo info = host_.contextInfo();
    static std::string logged;
    logged.clear();
    info.log = [](void*, RefletResult, const char* text) { logged = text; };
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    RefletView view = makeView(context, 3);
    RefletSettings settings = makeSettings("fast");
    const HostRoom room(host_, {});
    renderFrames(room, view, settings, 1);
    refletDestroyContext(context);
    EXPECT_NE(logged.find("has 1 views or radiance caches"), std::string::npos) << logged;
    refletDestroyContext(context);
    uint64_t bytes = 0;
    EXPECT_EQ(refletContextMemory(context, &bytes), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(refletLastError()).find("has been destroyed"), std::string::npos) << refletLastError();
    EXPECT_REFLET(refletFinishView(view));
    refletDestroyView(view);
    refletDestroyView(view);
    EXPECT_EQ(refletFinishView(view), REFLET_ERROR_INVALID_ARGUMENT);
    refletDestroySettings(settings);
    refletDestroySettings(settings);
    EXPECT_EQ(refletSetSetting(settings, "diffuse.rays", "2"), REFLET_ERROR_INVALID_ARGUMENT);
}

class Contact : public Library {
protected:
    Contact() : context_(host_.makeContext()), settings_(makeSettings("fast")), view_(makeView(context_, 3)) {
        EXPECT_REFLET(refletSetSetting(settings_, "shadow.filter", "hard"));
    }
    ~Contact() override {
        host_.host.waitForAll();
        refletDestroyView(view_);
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }
    template <class F>
    std::vector<uint8_t> visibility(const F& record) {
        RefletImage image{};
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo frame = room_.frame(commands, 0);
            EXPECT_REFLET(refletBeginFrame(view_, &frame));
            record(image);
            EXPECT_REFLET(refletEndFrame(view_));
        });
        host_.host.waitForAll();
        return texelsOf<uint8_t>(host_, image);
    }

    RefletContext context_;
    RefletSettings settings_;
    RefletView view_;
    const HostRoom room_{host_, {}};
};

TEST_F(Contact, OfALightIsThatOfTheSun) {
    EXPECT_REFLET(refletSetSetting(settings_, "contact.distance", "2"));
    EXPECT_REFLET(refletSetSetting(settings_, "contact.thickness", "1"));
    RefletSunShadow sun = room_.sun();
    sun.contactShadows = 1;
    const float toSun[] = {0.1F, 0.5F, -1.0F};  // low behind the wall
    std::ranges::copy(toSun, sun.toSun);
    sun.worldToClip[0][10] *= -1.0F;  // the map's depth rises toward it
    const std::vector<uint8_t> wanted =
        visibility([&](RefletImage& image) { EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &image)); });
    RefletContactLight light{sizeof light, {toSun[0], toSun[1], toSun[2]}, 0};
    const auto contact = [&](RefletImage& image) {
        EXPECT_REFLET(refletContactShadows(view_, settings_, &light, &image));
    };
    const std::vector<uint8_t> ofDirection = visibility(contact);
    // The sun's map is empty: all that it darkens besides is the wall, which faces away.
    constexpr size_t floor = size_t(HostRoom::width) * (HostRoom::height - 8);
    EXPECT_TRUE(std::equal(wanted.begin() + floor, wanted.end(), ofDirection.begin() + floor));
    for (size_t i = 0; i < wanted.size(); ++i) {
        ASSERT_LE(wanted[i], ofDirection[i]) << i;
    }
    EXPECT_GT(std::ranges::count(ofDirection, 0), 20) << "the floor at the wall's foot";
    for (float& value : light.light) {
        value *= 1e5F;
    }
    light.isPositional = 1;
    const std::vector<uint8_t> ofPoint = visibility(contact);
    int different = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        different += ofPoint[i] != ofDirection[i] ? 1 : 0;
    }
    EXPECT_LE(different, 10) << "as far away as a sun";
    // A lamp between floor and wall: nothing is between it and either.
    light = {sizeof light, {0.0F, 0.5F, -2.0F}, 1};
    EXPECT_EQ(std::ranges::count(visibility(contact), 0), 0);
}

TEST_F(Contact, IsRefusedWithoutDistanceOrLight) {
    visibility([&](RefletImage& image) {
        RefletContactLight light{sizeof light, {0.0F, 1.0F, 0.0F}, 0};
        EXPECT_EQ(refletContactShadows(view_, settings_, &light, &image), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(refletLastError()).find("contact.distance"), std::string::npos) << refletLastError();
        EXPECT_REFLET(refletSetSetting(settings_, "contact.distance", "1"));
        light.light[1] = 0.0F;
        EXPECT_EQ(refletContactShadows(view_, settings_, &light, &image), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_EQ(refletContactShadows(view_, settings_, nullptr, &image), REFLET_ERROR_INVALID_ARGUMENT);
        light.light[1] = 1.0F;
        light.isPositional = 7;
        EXPECT_EQ(refletContactShadows(view_, settings_, &light, &image), REFLET_ERROR_INVALID_ARGUMENT);
        light.isPositional = 0;
        for (int i = 0; i < REFLET_MAX_CONTACT_LIGHTS; ++i) {
            EXPECT_REFLET(refletContactShadows(view_, settings_, &light, &image));
        }
        EXPECT_EQ(refletContactShadows(view_, settings_, &light, &image), REFLET_ERROR_INVALID_ARGUMENT);
    });
}

}  // namespace
}  // namespace reflet::test
