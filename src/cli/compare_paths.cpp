// `reflet compare --paths`: a ledger of the difference by kinds of light paths, which renders and references have as
// layers.
#include "base/error.h"
#include "base/json_text.h"
#include "cli/compare.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace reflet {

namespace {

constexpr std::array layers{"direct", "indirect_diffuse", "indirect_specular"};

struct PathEntry {
    std::string layer;
    double share = 0.0;       ///< of the reference's light that is on these paths
    double difference = 0.0;  ///< of this layer, relative to all light of the reference; these sum to the bias
    Difference own;           ///< of the layer alone
};

double meanOf(const FloatImage& image, const std::vector<bool>& mask) {
    const size_t channels = image.channels.size();
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < image.data.size(); ++i) {
        if (mask.empty() || mask[i / channels]) {
            sum += image.data[i];
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

PictureName layerOf(PictureName name, const char* layer) {
    if (!name.exr || !name.layer.empty()) {
        failUsage("--paths {}: expected an EXR file, with the layers direct, indirect_diffuse and indirect_specular",
                  name.text);
    }
    name.layer = layer;
    return name;
}

FloatImage readLayer(const PictureName& name, const char* layer) {
    try {
        return readPicture(layerOf(name, layer));
    } catch (const UsageError&) {
        throw;
    } catch (const Error& error) {
        fail(
            "{} (--paths needs the layers of `reflet reference`, or of `reflet render --aov "
            "direct,indirect_diffuse,indirect_specular`)",
            error.what());
    }
}

std::vector<PathEntry> ledger(const CompareCommand& command, const PicturePair& names) {
    std::vector<PathEntry> entries;
    double all = 0.0;
    for (const char* layer : layers) {
        const FloatImage picture = readLayer(names[0], layer);
        const FloatImage truth = readLayer(names[1], layer);
        CompareOptions options{names[0].kind, command.pixelsPerDegree, {}, names[0].text, names[1].text, false};
        checkComparable(picture, truth, options);
        options.mask = loadMask(command.mask, names, picture);
        PathEntry entry{layer, meanOf(truth, options.mask), meanOf(picture, options.mask), {}};
        entry.difference -= entry.share;
        entry.own = compareImages(picture, truth, options).difference;
        all += entry.share;
        entries.push_back(std::move(entry));
    }
    for (PathEntry& entry : entries) {
        entry.share /= std::max(all, 1e-30);
        entry.difference /= std::max(all, 1e-30);
    }
    return entries;
}

}  // namespace

void comparePaths(const CompareCommand& command, const PicturePair& names) {
    const std::vector<PathEntry> entries = ledger(command, names);
    const double bias = std::accumulate(entries.begin(), entries.end(), 0.0,
                                        [](double sum, const PathEntry& entry) { return sum + entry.difference; });
    if (command.json) {
        nlohmann::ordered_json json{{"picture", command.picture}, {"truth", command.truth}, {"bias", bias}};
        for (const PathEntry& entry : entries) {
            json["paths"].push_back({{"layer", entry.layer},
                                     {"share", entry.share},
                                     {"part_of_bias", entry.difference},
                                     {"bias", entry.own.bias},
                                     {"relative_mse", entry.own.relativeMse},
                                     {"flip", entry.own.flip}});
        }
        fmt::print("{}\n", jsonText(json, 2));
        return;
    }
    fmt::print("{:<18} {:>9} {:>13} {:>9} {:>13} {:>8}\n", "light", "share", "part of bias", "own bias", "relative_mse",
               "flip");
    for (const PathEntry& entry : entries) {
        fmt::print("{:<18} {:>8.1f}% {:>+12.2f}% {:>+8.1f}% {:>13.6f} {:>8.4f}\n", entry.layer, 100.0 * entry.share,
                   100.0 * entry.difference, 100.0 * entry.own.bias, entry.own.relativeMse, entry.own.flip);
    }
    fmt::print("{:<18} {:>8.1f}% {:>+12.2f}%\n", "all", 100.0, 100.0 * bias);
}

}  // namespace reflet
