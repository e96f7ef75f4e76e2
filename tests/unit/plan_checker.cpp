// Checks plans the slow way: each pair of passes, each pair of resources, each barrier.
#include "unit/plan_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace reflet::test {

namespace {

using gpu::Access;
using gpu::GraphResource;
using gpu::PassGraph;
using gpu::Plan;
using gpu::PlannedBarrier;
using gpu::Transition;

constexpr VkAccessFlags2 writes = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

bool includes(const Access& a, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    return (a.stages & stages) == stages && (a.access & access) == access;
}

// A use of one resource at a position of the plan.
struct At {
    int64_t position = 0;  // -1: before the list
    Access access;
};

class Checker {
public:
    Checker(const PassGraph& graph, const Plan& plan) : graph_(graph), plan_(plan) {}

    std::string fault() {
        checkNeeded();
        if (fault_.empty()) {
            checkHazards();
            checkMemory();
            checkTransitions();
        }
        return fault_;
    }

private:
    template <class... Args>
    void say(fmt::format_string<Args...> format, Args&&... args) {
        if (fault_.empty()) {
            fault_ = fmt::format(format, std::forward<Args>(args)...);
        }
    }

    const Access* useOf(uint32_t pass, uint32_t resource) const {
        const gpu::GraphPass& p = graph_.passes[pass];
        for (uint32_t i = p.firstUse; i < p.firstUse + p.useCount; ++i) {
            if (graph_.uses[i].resource == resource) {
                return &graph_.uses[i].access;
            }
        }
        return nullptr;
    }

    // By growing the set of needed passes until nothing changes.
    void checkNeeded() {
        std::set<uint32_t> needed;
        const auto isNeeded = [&](uint32_t p) {
            if (graph_.passes[p].root) {
                return true;
            }
            for (uint32_t r = 0; r < graph_.resources.size(); ++r) {
                const Access* use = useOf(p, r);
                if (use == nullptr || !use->write) {
                    continue;
                }
                if (!graph_.resources[r].transient || graph_.resources[r].output) {
                    return true;
                }
                for (const uint32_t later : needed) {
                    if (later > p && useOf(later, r) != nullptr) {
                        return true;
                    }
                }
            }
            return false;
        };
        for (size_t before = SIZE_MAX; before != needed.size();) {
            before = needed.size();
            for (uint32_t p = 0; p < graph_.passes.size(); ++p) {
                if (isNeeded(p)) {
                    needed.insert(p);
                }
            }
        }
        std::vector<uint32_t> order = plan_.order;
        std::ranges::sort(order);
        if (!std::ranges::equal(order, needed)) {
            say("passes {} are planned, and {} needed", fmt::join(order, " "), fmt::join(needed, " "));
        }
    }

    bool barrierBetween(const At& first, const At& second) const {
        return std::ranges::any_of(plan_.barriers, [&](const PlannedBarrier& b) {
            return int64_t(b.before) > first.position && int64_t(b.before) <= second.position &&
                   includes(b.from, first.access.stages, first.access.access & writes) &&
                   includes(b.to, second.access.stages, second.access.access);
        });
    }

    // All uses of a resource in the order of the list, with their positions in the plan.
    std::vector<At> usesOf(uint32_t resource) const {
        std::vector<At> uses;
        for (uint32_t p = 0; p < graph_.passes.size(); ++p) {
            const auto position = std::ranges::find(plan_.order, p);
            const Access* use = useOf(p, resource);
            if (position != plan_.order.end() && use != nullptr) {
                uses.push_back({position - plan_.order.begin(), *use});
            }
        }
        return uses;
    }

    void checkHazards() {
        for (uint32_t r = 0; r < graph_.resources.size(); ++r) {
            const std::vector<At> uses = usesOf(r);
            for (size_t later = 0; later < uses.size(); ++later) {
                checkUse(r, uses, later);
            }
        }
    }

    // A use waits for the last write before it, and a write for all reads since.
    void checkUse(uint32_t r, const std::vector<At>& uses, size_t later) {
        bool written = false;
        for (size_t i = later; i-- > 0 && !written;) {
            written = uses[i].access.write;
            if (!written && !uses[later].access.write) {
                continue;
            }
            if (uses[i].position >= uses[later].position) {
                say("resource {}: positions {} and {} changed places", r, uses[i].position, uses[later].position);
            } else if (!barrierBetween(uses[i], uses[later])) {
                say("resource {}: no barrier between {} and {}", r, uses[i].position, uses[later].position);
            }
        }
        const GraphResource& resource = graph_.resources[r];
        const gpu::AccessState& before = resource.before;
        if (written || resource.transient || resource.undefined) {
            return;  // its transition waits
        }
        const Access& access = uses[later].access;
        const bool seen = before.visibleStages != 0 &&
                          includes({before.visibleStages, before.visibleAccess, false}, access.stages, access.access);
        const At write{-1, {before.writeStages, before.writeAccess, true}};
        if (before.writeStages != 0 && (access.write || !seen) && !barrierBetween(write, uses[later])) {
            say("resource {}: no barrier between the write before the list and {}", r, uses[later].position);
        }
        if (access.write && before.readStages != 0 &&
            !barrierBetween({-1, {before.readStages, 0, false}}, uses[later])) {
            say("resource {}: no barrier between the reads before the list and {}", r, uses[later].position);
        }
    }

    VkDeviceSize offsetOf(uint32_t r) const {
        return graph_.resources[r].held ? graph_.resources[r].offset : plan_.offsets[r];
    }

    bool hasMemory(uint32_t r) const { return graph_.resources[r].held || plan_.offsets[r] != Plan::unplaced; }

    bool overlap(uint32_t a, uint32_t b) const {
        return graph_.resources[a].heap == graph_.resources[b].heap &&
               offsetOf(a) < offsetOf(b) + graph_.resources[b].size &&
               offsetOf(b) < offsetOf(a) + graph_.resources[a].size;
    }

    void checkMemory() {
        for (uint32_t a = 0; a < graph_.resources.size(); ++a) {
            const std::vector<At> usesA = usesOf(a);
            const bool placed = plan_.offsets[a] != Plan::unplaced;
            if (placed != (graph_.resources[a].transient && !usesA.empty())) {
                say("resource {} is {}placed", a, placed ? "" : "not ");
            }
            if (!placed) {
                continue;
            }
            checkPlace(a, usesA);
            for (uint32_t b = 0; b < graph_.resources.size(); ++b) {
                if (b != a && hasMemory(b) && overlap(a, b) && !usesOf(b).empty()) {
                    checkSharing(a, usesA, b, usesOf(b));
                    checkSharing(b, usesOf(b), a, usesA);
                }
            }
        }
    }

    void checkPlace(uint32_t r, const std::vector<At>& uses) {
        const GraphResource& resource = graph_.resources[r];
        const gpu::GraphHeap& heap = graph_.heaps[resource.heap];
        const VkDeviceSize end = plan_.offsets[r] + resource.size;
        if (plan_.offsets[r] % resource.alignment != 0 || end > plan_.ends[resource.heap]) {
            say("resource {} is at {}", r, plan_.offsets[r]);
        }
        for (const gpu::MemoryRange& taken : heap.taken) {
            if (taken.offset < end && plan_.offsets[r] < taken.offset + taken.size) {
                say("resource {} lies in memory that is taken", r);
            }
        }
        VkDeviceSize border = 0;
        for (const VkDeviceSize block : heap.blocks) {
            border += block;
            if (plan_.offsets[r] < border && end > border) {
                say("resource {} lies across the border at {}", r, border);
            }
        }
        for (const gpu::HeldRange& held : heap.held) {
            if (held.range.offset < end && plan_.offsets[r] < held.range.offset + held.range.size) {
                checkHeld(r, uses, held);
            }
        }
        const At first = *std::ranges::min_element(uses, {}, &At::position);
        if (heap.before.stages != 0 && !barrierBetween({-1, heap.before}, first)) {
            say("resource {} does not wait for what was in its memory before the list", r);
        }
    }

    // Held memory is used by others only while nobody needs what it holds.
    void checkHeld(uint32_t r, const std::vector<At>& uses, const gpu::HeldRange& held) {
        const bool listed = held.resource != gpu::HeldRange::unused;
        const std::vector<At> own = listed ? usesOf(held.resource) : std::vector<At>{};
        const bool output = graph_.resources[r].output;
        for (const At& mine : uses) {
            for (const At& its : own) {
                const bool early = held.use == gpu::HeldUse::untilLast && mine.position <= its.position;
                const bool late = held.use == gpu::HeldUse::fromFirst && mine.position >= its.position;
                if (early || late) {
                    say("resource {} is at {} in memory that is held", r, mine.position);
                }
            }
        }
        if (held.use == gpu::HeldUse::busy || (held.use == gpu::HeldUse::fromFirst && output)) {
            say("resource {} lies in memory that is held", r);
        }
    }

    void checkSharing(uint32_t a, const std::vector<At>& usesA, uint32_t b, const std::vector<At>& usesB) {
        const auto last = [](const std::vector<At>& uses) {
            return std::ranges::max(uses, {}, &At::position).position;
        };
        const auto first = [](const std::vector<At>& uses) { return std::ranges::min(uses, {}, &At::position); };
        if (last(usesA) > first(usesB).position) {
            if (last(usesB) > first(usesA).position) {
                say("resources {} and {} share memory at the same time", a, b);
            }
            return;  // the other way around
        }
        if (graph_.resources[a].output) {
            say("resource {} gets the memory of the output {}", b, a);
        }
        // Whatever b's first use could overtake: the last write of a, and the reads since.
        for (size_t i = usesA.size(); i-- > 0;) {
            if (!barrierBetween(usesA[i], first(usesB))) {
                say("no barrier between resources {} and {} in the same memory", a, b);
            }
            if (usesA[i].access.write) {
                break;
            }
        }
    }

    void checkTransitions() {
        std::vector<int> count(graph_.resources.size());
        for (const PlannedBarrier& barrier : plan_.barriers) {
            for (const Transition& t : barrier.transitions) {
                ++count[t.resource];
                checkTransition(barrier, t);
            }
        }
        for (uint32_t r = 0; r < count.size(); ++r) {
            const GraphResource& resource = graph_.resources[r];
            const bool wanted = resource.image && (resource.transient || resource.undefined) && !usesOf(r).empty();
            if (count[r] != (wanted ? 1 : 0)) {
                say("image {}: {} transitions", r, count[r]);
            }
        }
    }

    void checkTransition(const PlannedBarrier& barrier, const Transition& t) {
        for (const At& use : usesOf(t.resource)) {
            if (use.position < int64_t(barrier.before)) {
                say("image {} is used at {} before its transition", t.resource, use.position);
            }
            const At transition{barrier.before, {t.to.stages, 0, true}};
            if (!includes(t.to, use.access.stages, use.access.access) && !barrierBetween(transition, use)) {
                say("image {}: {} does not see its transition", t.resource, use.position);
            }
            if (use.access.write) {
                break;  // what comes later waits for this
            }
        }
        if (!hasMemory(t.resource)) {
            return;
        }
        for (uint32_t other = 0; other < graph_.resources.size(); ++other) {
            if (other == t.resource || !hasMemory(other) || !overlap(other, t.resource)) {
                continue;
            }
            for (const At& use : usesOf(other)) {
                if (use.position < int64_t(plan_.lifetimes[t.resource].first) &&
                    use.position >= int64_t(barrier.before)) {
                    say("image {} changes while {} is in its memory", t.resource, other);
                }
            }
        }
    }

    const PassGraph& graph_;
    const Plan& plan_;
    std::string fault_;
};

}  // namespace

std::string faultOf(const gpu::PassGraph& graph, const gpu::Plan& plan) {
    return Checker(graph, plan).fault();
}

}  // namespace reflet::test
