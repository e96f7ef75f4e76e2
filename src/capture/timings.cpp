// Collects device times of passes over several frames.
#include "capture/timings.h"

#include "capture/spread.h"

#include <nlohmann/json.hpp>

namespace reflet {

void Timings::add(const std::vector<gpu::PassTime>& times) {
    ++frames_;
    if (frames_ == 2 && leaveOutFirst_) {
        samples_.clear();
        order_.clear();
    }
    for (const gpu::PassTime& time : times) {
        if (samples_[time.name].empty()) {
            order_.push_back(time.name);
        }
        samples_[time.name].push_back(time.ms);
    }
}

double Timings::frameMs() const {
    return spreadOf(samples_.at("frame")).median;
}

std::vector<gpu::PassTime> Timings::passes() const {
    std::vector<gpu::PassTime> result;
    for (const std::string& name : order_) {
        if (name != "frame") {
            result.push_back({name, spreadOf(samples_.at(name)).median});
        }
    }
    return result;
}

nlohmann::ordered_json Timings::json(const std::string& device, uvec2 size) const {
    nlohmann::ordered_json byName = nlohmann::ordered_json::object();
    for (const gpu::PassTime& pass : passes()) {
        byName[pass.name] = pass.ms;
    }
    return {{"device", device},
            {"size", {size.x, size.y}},
            {"frames", frames_},
            {"frame_ms", frameMs()},
            {"passes", byName}};
}

}  // namespace reflet
