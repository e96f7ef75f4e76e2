// The C API on a host's device: frames in flight, pipelines, memory, resets, devices and threads.
#include "library/library_fixture.h"

#include <thread>

namespace reflet::test {
namespace {

using Made = LibraryHost::Made;

TEST_F(Library, AnyNumberOfFramesInFlightGivesTheSame) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    const HostRoom room(host_, {});
    std::vector<uint32_t> first;
    for (uint32_t framesInFlight = 1; framesInFlight <= REFLET_MAX_FRAMES_IN_FLIGHT; ++framesInFlight) {
        RefletView view = makeView(context, framesInFlight);
        const RoomResults results = renderFrames(room, view, settings, 6, framesInFlight < Host::framesInFlight);
        const std::vector<uint32_t> display = texelsOf<uint32_t>(host_, results.display);
        first = first.empty() ? display : first;
        EXPECT_EQ(display, first) << framesInFlight;
        refletDestroyView(view);
    }
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, PreparesAllPipelinesAndMakesNothingInLaterFrames) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("balanced");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const RefletFrameInfo frame = room.frame(VK_NULL_HANDLE, 0);
    RefletPrepareInfo info{};
    info.structSize = sizeof info;
    info.effects = REFLET_EFFECT_SUN_SHADOW | REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_REFLECTIONS |
                   REFLET_EFFECT_COMPOSITE | REFLET_EFFECT_TEMPORAL | REFLET_EFFECT_TONE_MAP |
                   REFLET_EFFECT_AMBIENT_OCCLUSION | REFLET_EFFECT_DEPTH_OF_FIELD;
    info.gbuffer = frame.gbuffer;
    info.shadowMapSide = 64;
    info.autoExposure = 1;
    uint32_t left = 0;
    EXPECT_REFLET(refletSetSetting(settings, "ao.method", "bitmask"));
    EXPECT_REFLET(refletPrepare(view, settings, &info, 0, &left));
    EXPECT_GT(left, 10U);
    const uint32_t all = left;
    for (uint32_t calls = 1; left > 0; ++calls) {
        ASSERT_LE(calls, all);
        EXPECT_REFLET(refletPrepare(view, settings, &info, 4, &left));
        EXPECT_EQ(left, all - std::min(all, 4 * calls));
    }
    EXPECT_EQ(LibraryHost::made().pipelines, all);
    renderFrames(room, view, settings, 1);
    EXPECT_EQ(LibraryHost::made().pipelines, all) << "the first frame made pipelines";
    renderFrames(room, view, settings, 3);
    const Made made = LibraryHost::made();
    renderFrames(room, view, settings, 5);
    EXPECT_TRUE(LibraryHost::made() == made) << "a later frame made something";
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, TellsItsMemoryAndGivesAllBack) {
    struct Blocks {
        std::vector<std::pair<VkDeviceMemory, VkDeviceSize>> live;
    } blocks;
    RefletMemoryCallbacks calls{};
    calls.structSize = sizeof calls;
    calls.user = &blocks;
    static VkDevice device = VK_NULL_HANDLE;
    device = host_.host.device().device;
    static PFN_vkAllocateMemory allocate = nullptr;
    static PFN_vkFreeMemory release = nullptr;
    const auto find = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        host_.host.device().lookUp(host_.host.device().instance, "vkGetDeviceProcAddr"));
    allocate = reinterpret_cast<PFN_vkAllocateMemory>(find(device, "vkAllocateMemory"));
    release = reinterpret_cast<PFN_vkFreeMemory>(find(device, "vkFreeMemory"));
    calls.allocate = [](void* user, const VkMemoryAllocateInfo* info, VkDeviceMemory* memory) {
        const VkResult result = allocate(device, info, nullptr, memory);
        static_cast<Blocks*>(user)->live.emplace_back(*memory, info->allocationSize);
        return result;
    };
    calls.free = [](void* user, VkDeviceMemory memory) {
        std::erase_if(static_cast<Blocks*>(user)->live, [&](const auto& block) { return block.first == memory; });
        release(device, memory, nullptr);
    };
    RefletContextInfo info = host_.contextInfo();
    info.memory = &calls;
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    RefletSettings settings = makeSettings("fast");
    const HostRoom room(host_, {});
    RefletView one = makeView(context, 3);
    RefletView other = makeView(context, 3);
    renderFrames(room, one, settings, 4);
    const auto memoryOf = [](RefletView view) {
        uint64_t bytes = 0;
        EXPECT_REFLET(refletViewMemory(view, &bytes));
        return bytes;
    };
    const uint64_t first = memoryOf(one);
    EXPECT_GT(first, uint64_t(HostRoom::width) * HostRoom::height * 100);
    renderFrames(room, other, settings, 4);
    EXPECT_EQ(memoryOf(one), first);
    EXPECT_EQ(memoryOf(other), first) << "the same work takes the same memory";
    uint64_t reserved = 0;
    EXPECT_REFLET(refletContextMemory(context, &reserved));
    uint64_t live = 0;
    for (const auto& [memory, bytes] : blocks.live) {
        live += bytes;
    }
    EXPECT_EQ(reserved, live);
    EXPECT_GE(reserved, 2 * first);
    EXPECT_EQ(LibraryHost::made().allocations, 0U) << "past the callbacks";
    refletDestroyView(one);
    refletDestroyView(other);
    refletDestroySettings(settings);
    refletDestroyContext(context);
    EXPECT_TRUE(blocks.live.empty());
}

TEST_F(Library, ManySizesLeaveNoMemoryBehind) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    renderFrames(room, view, settings, 4);
    uint64_t before = 0;
    EXPECT_REFLET(refletViewMemory(view, &before));
    for (uint32_t i = 0; i < 6; ++i) {
        EXPECT_REFLET(refletResizeView(view, 100 + i, 50 + 3 * i));
        EXPECT_REFLET(refletResizeView(view, HostRoom::width, HostRoom::height));
        renderFrames(room, view, settings, 1);
    }
    renderFrames(room, view, settings, 4);
    EXPECT_REFLET(refletFinishView(view));
    uint64_t after = 0;
    EXPECT_REFLET(refletViewMemory(view, &after));
    EXPECT_EQ(after, before);
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

// After a reset the view does what it did in its first frame.
TEST_F(Library, AResetForgetsTheHistory) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const std::vector<uint32_t> first = texelsOf<uint32_t>(host_, renderFrames(room, view, settings, 1).display);
    const std::vector<uint32_t> later = texelsOf<uint32_t>(host_, renderFrames(room, view, settings, 4).display);
    EXPECT_NE(first, later);
    EXPECT_REFLET(refletResetView(view));
    EXPECT_EQ(texelsOf<uint32_t>(host_, renderFrames(room, view, settings, 1).display), first);
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, WorksOnTwoDevicesOnTwoThreads) {
    LibraryHost second;
    LibraryHost* hosts[2] = {&host_, &second};
    std::vector<uint32_t> pictures[2];
    const auto work = [&](int k) {
        LibraryHost& host = *hosts[k];
        RefletContext context = host.makeContext();
        RefletSettings settings = makeSettings("fast");
        RefletView view = makeView(context, 3);
        {
            const HostRoom room(host, {});
            RoomResults results;
            for (uint32_t i = 0; i < 4; ++i) {
                host.host.frame(
                    [&](VkCommandBuffer commands) { results = recordRoom(room, view, settings, commands, i); });
            }
            host.host.waitForAll();
            pictures[k] = texelsOf<uint32_t>(host, results.display);
        }
        refletDestroyView(view);
        refletDestroySettings(settings);
        refletDestroyContext(context);
    };
    std::thread thread([&] { work(0); });
    work(1);
    thread.join();
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_FALSE(pictures[0].empty());
    for (const std::string& message : second.host.messages()) {
        ADD_FAILURE() << message;
    }
}

}  // namespace
}  // namespace reflet::test
