// Draws random numbers.
#include "dataset/draws.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace reflet {

namespace {

uint64_t mixed(uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

constexpr double sensorHeight = 24.0;  // millimetres, of focal lengths

bool parseNumber(std::string_view text, double& value) {
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end && std::isfinite(value);
}

}  // namespace

Draws::Draws(uint64_t seed, uint64_t stream) : state_(mixed(seed + 0x9E3779B97F4A7C15ULL) ^ mixed(stream + 1)) {}

uint64_t Draws::bits() {
    state_ += 0x9E3779B97F4A7C15ULL;
    return mixed(state_);
}

double Draws::unit() {
    return static_cast<double>(bits() >> 11U) * 0x1p-53;
}

// The sum of twelve uniform numbers: unlike formulas with logarithms, the same on every machine.
double Draws::normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
        sum += unit();
    }
    return std::clamp(sum, -3.0, 3.0);
}

vec3 Draws::direction() {
    for (;;) {  // by rejection, without trigonometry
        const vec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
        const float square = glm::dot(v, v);
        if (square > 0.01F && square <= 1.0F) {
            return v / std::sqrt(square);
        }
    }
}

double Distribution::draw(Draws& draws) const {
    switch (kind) {
        case Kind::none:
            return 0.0;
        case Kind::uniform:
            return draws.between(low, high);
        case Kind::normal:
            return low + high * draws.normal();
        case Kind::lens:
            break;
    }
    const double focal = std::exp(draws.between(std::log(low), std::log(high)));
    return glm::degrees(2.0 * std::atan(0.5 * sensorHeight / focal));
}

std::vector<NamedDistribution> heightDistributions() {
    using enum Distribution::Kind;
    return {{"free", "anywhere in free space", {none, 0, 0}},
            {"eye", "1.6 m, normal with a deviation of 0.1", {normal, 1.6, 0.1}},
            {"child", "1.1 m, normal with a deviation of 0.1", {normal, 1.1, 0.1}},
            {"low", "0.2 to 0.6 m", {uniform, 0.2, 0.6}},
            {"drone", "2 to 8 m", {uniform, 2.0, 8.0}}};
}

std::vector<NamedDistribution> fovDistributions() {
    using enum Distribution::Kind;
    return {{"normal", "40 to 65 degrees", {uniform, 40, 65}},
            {"wide", "65 to 95 degrees", {uniform, 65, 95}},
            {"tele", "15 to 35 degrees", {uniform, 15, 35}},
            {"lenses", "focal lengths of 18 to 85 mm over a sensor of 36x24 mm, log-uniform", {lens, 18, 85}}};
}

Distribution parseDistribution(std::string_view option, const std::string& text,
                               const std::vector<NamedDistribution>& named, double least, double most) {
    if (const auto found = std::ranges::find(named, text, &NamedDistribution::name); found != named.end()) {
        return found->distribution;
    }
    const std::string_view all = text;
    const size_t dots = all.find("..");
    Distribution range{Distribution::Kind::uniform, 0, 0};
    if (dots == std::string_view::npos || !parseNumber(all.substr(0, dots), range.low) ||
        !parseNumber(all.substr(dots + 2), range.high)) {
        std::vector<std::string> names;
        std::ranges::transform(named, std::back_inserter(names), [](const auto& n) { return std::string(n.name); });
        failUsage("{} '{}': must be {}{}a range A..B{}", option, text, fmt::join(names, ", "),
                  names.empty() ? "" : " or ", suggestion(text, names));
    }
    if (range.low > range.high || range.low < least || range.high > most) {
        failUsage("{} {}: A..B must ascend within {:g}..{:g}", option, text, least, most);
    }
    return range;
}

std::string listed(const std::vector<NamedDistribution>& named) {
    std::string text;
    for (const NamedDistribution& n : named) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", n.name, n.meaning);
    }
    return text;
}

}  // namespace reflet
