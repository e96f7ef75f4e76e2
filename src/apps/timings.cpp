// Device times of passes over several frames.
#include "apps/timings.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet {

namespace {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) {
        return *middle;
    }
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

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
    return median(samples_.at("frame"));
}

std::vector<gpu::PassTime> Timings::passes() const {
    std::vector<gpu::PassTime> result;
    for (const std::string& name : order_) {
        if (name != "frame") {
            result.push_back({name, median(samples_.at(name))});
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
