// Writes and reads timestamps.
#include "gpu/pass_times.h"

#include "gpu/context.h"

#include <algorithm>
#include <span>

namespace reflet::gpu {

namespace {

constexpr uint32_t passesPerPool = 256;
constexpr uint32_t queriesPerPass = 3;
constexpr uint32_t perPool = queriesPerPass * passesPerPool;

// The string keeps its memory.
PassTime& nextTime(std::vector<PassTime>& times, size_t& used) {
    if (used == times.size()) {
        times.emplace_back();
    }
    return times[used++];
}

}  // namespace

void PassTimers::makePool(Frame& frame) {
    if (!measures_) {
        return;
    }
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = perPool;
    frame.pools.reserve(frame.pools.size() + 1);
    VkQueryPool pool = VK_NULL_HANDLE;
    vkCheck(context_.vk.vkCreateQueryPool(context_.handle(), &info, context_.allocator(), &pool),
            "creating a query pool");
    frame.pools.push_back(pool);
}

void PassTimers::destroy(Frame& frame) {
    for (const VkQueryPool pool : frame.pools) {
        context_.vk.vkDestroyQueryPool(context_.handle(), pool, context_.allocator());
    }
}

void PassTimers::reset(Frame& frame, VkCommandBuffer commands) const {
    frame.passes.clear();
    for (const VkQueryPool pool : frame.pools) {
        context_.vk.vkCmdResetQueryPool(commands, pool, 0, perPool);
    }
}

std::pair<VkQueryPool, uint32_t> PassTimers::timestamp(Frame& frame, VkCommandBuffer commands, uint32_t which) {
    const auto pass = static_cast<uint32_t>(frame.passes.size() - 1);
    if (pass / passesPerPool == frame.pools.size()) {
        makePool(frame);
        context_.vk.vkCmdResetQueryPool(commands, frame.pools.back(), 0, perPool);
    }
    return {frame.pools[pass / passesPerPool], queriesPerPass * (pass % passesPerPool) + which};
}

void PassTimers::begin(Frame& frame, VkCommandBuffer commands, const Timed& pass) {
    context_.beginLabel(commands, pass.name.data());  // of a string, so that it ends with a zero
    if (!measures_) {
        return;
    }
    frame.passes.push_back(pass);
    // The second timestamp is never read. llvmpipe takes a timestamp only when the next one flushes it, which otherwise
    // would be after the pass.
    for (const uint32_t which : {0U, 1U}) {
        const auto [pool, query] = timestamp(frame, commands, which);
        context_.vk.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    }
}

void PassTimers::end(Frame& frame, VkCommandBuffer commands) {
    if (measures_) {
        const auto [pool, query] = timestamp(frame, commands, 2);
        context_.vk.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    }
    context_.endLabel(commands);
}

void PassTimers::read(const Frame& frame, std::vector<PassTime>& times) {
    size_t used = 0;
    const std::vector<Timed>& passes = frame.passes;
    if (passes.empty()) {
        times.clear();
        return;
    }
    ticks_.resize(queriesPerPass * passes.size());
    for (size_t first = 0; first < ticks_.size(); first += perPool) {
        const std::span<uint64_t> part =
            std::span(ticks_).subspan(first, std::min<size_t>(perPool, ticks_.size() - first));
        const VkResult result = context_.vk.vkGetQueryPoolResults(
            context_.handle(), frame.pools[first / perPool], 0, static_cast<uint32_t>(part.size()), part.size_bytes(),
            part.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
        if (result == VK_NOT_READY) {  // the commands were never submitted
            times.clear();
            return;
        }
        if (result == VK_ERROR_DEVICE_LOST) {
            context_.noteLost();
        }
        vkCheck(result, "reading timestamps");
    }
    const double tick = context_.limits().timestampPeriod * 1e-6;
    PassTime& whole = nextTime(times, used);
    whole.name = "frame";
    whole.ms = static_cast<double>(ticks_.back() - ticks_.front()) * tick;
    whole.bytes = 0;
    whole.raster = false;
    indices_.clear();
    for (size_t i = 0; i < passes.size(); ++i) {
        indices_.resize(std::max<size_t>(indices_.size(), passes[i].nameIndex + 1));
        uint32_t& index = indices_[passes[i].nameIndex];
        if (index == 0) {
            PassTime& time = nextTime(times, used);
            index = static_cast<uint32_t>(used);
            time.name = passes[i].name;
            time.ms = 0.0;
            time.bytes = 0;
            time.raster = passes[i].raster;
        }
        PassTime& time = times[index - 1];
        time.ms += static_cast<double>(ticks_[queriesPerPass * i + 2] - ticks_[queriesPerPass * i]) * tick;
        time.bytes += passes[i].bytes;
        times.front().bytes += passes[i].bytes;
    }
    times.resize(used);
}

}  // namespace reflet::gpu
