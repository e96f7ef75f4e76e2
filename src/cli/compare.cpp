// `reflet compare`: measures the error of an image against a reference.
#include "cli/compare.h"
#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/in_range.h"
#include "cli/output_files.h"
#include "compare/heat_map.h"
#include "job/sequence_names.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

namespace reflet {

namespace {

Limit parseLimit(const std::string& text) {
    const size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::vector<Metric> all = comparedMetrics();
    const auto metric = std::ranges::find(all, name, &Metric::name);
    if (metric == all.end()) {
        std::vector<std::string> names;
        std::ranges::transform(all, std::back_inserter(names), [](const Metric& m) { return std::string(m.name); });
        failUsage("--fail-above {}: there is no metric '{}'; available: {}{}", text, name, fmt::join(names, ", "),
                  suggestion(name, names));
    }
    double value = 0.0;
    const char* end = text.data() + text.size();
    const char* begin = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || rest != end || !std::isfinite(value)) {
        failUsage("--fail-above {}: expected METRIC=NUMBER, such as {}=0.1", text, name);
    }
    return {*metric, value};
}

void checkOutput(std::string_view option, const std::string& file, std::string_view ending) {
    if (file.empty()) {
        return;
    }
    if (!file.ends_with(ending)) {
        failUsage("{} {}: the name must end in {}", option, file, ending);
    }
}

void printTable(const Difference& difference, uint64_t pixels) {
    for (const Metric& metric : comparedMetrics()) {
        fmt::print("{:<13} {}\n", metric.name, valueText(metric, metric.value(difference)));
    }
    fmt::print("{:<13} {} of {}\n", "pixels", difference.pixels, pixels);
}

// JSON has no infinity: it becomes null.
void printJson(const CompareCommand& command, const FloatImage& flip, ImageKind kind, const Difference& difference) {
    nlohmann::ordered_json json{{"picture", command.picture},
                                {"truth", command.truth},
                                {"kind", kind == ImageKind::linear ? "linear" : "display"},
                                {"size", {flip.width, flip.height}},
                                {"pixels_per_degree", command.pixelsPerDegree}};
    for (const Metric& metric : comparedMetrics()) {
        json[std::string(metric.name)] = metric.value(difference);
    }
    json["pixels"] = difference.pixels;
    fmt::print("{}\n", jsonText(json, 2));
}

void checkLimits(const std::vector<Limit>& limits, const Difference& difference) {
    std::vector<std::string> broken;
    for (const Limit& limit : limits) {
        if (limit.isBroken(difference)) {
            broken.push_back(fmt::format("{} is {}, {} the limit {}", limit.metric.name,
                                         valueText(limit.metric, limit.metric.value(difference)),
                                         limit.metric.largeIsGood ? "below" : "above", limit.value));
        }
    }
    if (!broken.empty()) {
        fail("{}", fmt::join(broken, "; "));
    }
}

void compareOne(const CompareCommand& command, const PicturePair& names, const std::vector<Limit>& limits) {
    const Comparison result = comparePair(command, names);
    if (!command.heatMap.empty()) {
        writePng(command.heatMap, heatMap(result.flip));
    }
    if (command.json) {
        printJson(command, result.flip, names[0].kind, result.difference);
    } else {
        printTable(result.difference, result.flip.data.size());
    }
    checkLimits(limits, result.difference);
}

void compare(const CompareCommand& command) {
    std::vector<Limit> limits;
    std::ranges::transform(command.failAbove, std::back_inserter(limits), parseLimit);
    const PicturePair names{parsePictureName(command.picture), parsePictureName(command.truth)};
    if (names[0].kind != names[1].kind) {
        failUsage("{} and {}: one is linear, the other display-encoded; compare two images of the same kind",
                  command.picture, command.truth);
    }
    if (command.paths && (FrameNames::isPattern(names[0].file) || !command.heatMap.empty() || !limits.empty())) {
        failUsage("--paths: compares two images, without --heatmap and --fail-above");
    }
    checkOutput("--heatmap", command.heatMap, ".png");
    checkOutput("--plot", command.plot, ".svg");
    tryOutputs({command.heatMap, command.plot}, {{names[0].file, names[1].file, command.mask}, {}});
    if (FrameNames::isPattern(names[0].file)) {
        compareSequences(command, names, limits);
        return;
    }
    for (const std::string& file : {names[1].file, command.mask, command.heatMap}) {
        if (FrameNames::isPattern(file)) {
            failUsage("{}: it names a sequence, but {} is one image: name A with a run of #, too", file,
                      command.picture);
        }
    }
    if (!command.plot.empty()) {
        failUsage("--plot is only for sequences: name the images with a run of #, as in a_####.exr b_####.exr");
    }
    if (command.paths) {
        comparePaths(command, names);
        return;
    }
    compareOne(command, names, limits);
}

std::string compareFooter() {
    std::string text = "Metrics (a: a value of A, b: the same value of B):\n";
    for (const Metric& metric : comparedMetrics()) {
        text += fmt::format("  {:<13} {}{}\n", metric.name, metric.definition,
                            metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit));
    }
    return text +
           "  pixels        number of pixels compared\n"
           "A pattern's wavelength is the shorter one of those along rows and columns. With a mask, the other pixels'\n"
           "errors count as 0 in the octaves. Noise of the reference counts, too, mostly in the finest octave.\n"
           ".png and .jpg files are display-encoded, and compared as stored (0..1); .exr and .hdr files are linear.\n"
           "Both images must have the same kind, size and number of channels (1 or 3); alpha is ignored. HDR-FLIP\n"
           "derives its exposures from all of B, and a pixel's FLIP depends on its neighbours, masked or not.\n"
           "--mask hits keeps the pixels where both EXR files have data: layer confidence above 0 in any channel,\n"
           "or, in a file without that layer, depth above 0 (reflet render --aov depth).\n"
           "--json prints { picture, truth, kind, size, pixels_per_degree, METRIC..., pixels }; infinity is null.\n"
           "Sequences: every frame of B is compared with the frame of A that has its number; B may also be one image.\n"
           "Prints every frame, the means and the worst frame of each metric (bias: the largest |bias|; JSON: frames,\n"
           "mean, worst); then the same of the octaves. --fail-above holds for every frame.\n"
           "--paths needs both files' layers direct, indirect_diffuse and indirect_specular: reflet reference writes "
           "them,\n"
           "reflet render with --aov direct,indirect_diffuse,indirect_specular.\n"
           "Example: reflet compare image.exr reference.exr:final --mask hits --heatmap error.png --fail-above "
           "flip=0.1\n"
           "reflet compare noisy_####.exr clean_####.exr --plot error.svg --heatmap worst.png";
}

}  // namespace

std::vector<bool> loadMask(const std::string& mask, const PicturePair& names, const FloatImage& picture) {
    if (mask.empty()) {
        return {};
    }
    return mask == "hits" ? readHitMask(names, picture) : readMask(parsePictureName(mask), picture);
}

bool Limit::isBroken(const Difference& difference) const {
    const double is = metric.value(difference);
    return metric.largeIsGood ? is < value : is > value;
}

std::vector<Metric> comparedMetrics() {
    std::vector<Metric> all(metrics().begin(), metrics().end());
    all.insert(all.end(), octaveMetrics().begin(), octaveMetrics().end());
    return all;
}

std::string valueText(const Metric& metric, double value) {
    return fmt::format("{:.6g}{}{}", value, metric.unit.empty() ? "" : " ", metric.unit);
}

/// Measured: FLIP of linear images takes most.
void checkMemory(const FloatImage& picture, const std::string& name) {
    constexpr uint64_t bytesPerPixel = 140;
    constexpr double gib = 1U << 30U;
    const uint64_t limit = memoryLimit();
    const uint64_t bytes = uint64_t(picture.width) * picture.height * bytesPerPixel;
    if (bytes > limit) {
        fail("{}: to compare {} x {} pixels takes {:.1f} GiB, more than the limit of {:.3g} GiB: {}", name,
             picture.width, picture.height, static_cast<double>(bytes) / gib, static_cast<double>(limit) / gib,
             raiseMemoryLimit(bytes));
    }
}

Comparison comparePair(const CompareCommand& command, const PicturePair& names) {
    const FloatImage picture = readPicture(names[0]);
    checkMemory(picture, names[0].text);
    const FloatImage truth = readPicture(names[1]);
    CompareOptions options{names[0].kind, command.pixelsPerDegree, {}, names[0].text, names[1].text, true};
    checkComparable(picture, truth, options);
    options.mask = loadMask(command.mask, names, picture);
    return compareImages(picture, truth, options);
}

void addCompareCommand(CLI::App& app) {
    auto options = std::make_shared<CompareCommand>();
    CLI::App* command = app.add_subcommand("compare", "Measure the error of an image against a reference");
    command
        ->add_option(
            "A", options->picture,
            "Image: .png, .jpg, .hdr or .exr; select a layer as FILE.exr:LAYER. With a run of #, as in a_####.exr, "
            "a sequence")
        ->required();
    command
        ->add_option("B", options->truth,
                     "Reference image, in the same formats; without a layer, the unnamed one (final)")
        ->required();
    command
        ->add_option(
            "--mask", options->mask,
            "Pixels to compare: those above 0.5 in an image (or in each of a sequence), or 'hits': those where both "
            "files have data")
        ->type_name("FILE|hits");
    command
        ->add_option(
            "--heatmap", options->heatMap,
            "Write per-pixel FLIP as an image, dark 0 to light 1. Sequences: of the frame with the largest FLIP, "
            "or, with a run of #, of every frame")
        ->type_name("F.png");
    command->add_option("--plot", options->plot, "Sequences: write all metrics over the frames as a plot")
        ->type_name("F.svg");
    command->add_flag("--json", options->json, "Print JSON instead of a table");
    command->add_flag(
        "--paths", options->paths,
        "Print where the light is missing or too much: for direct light, light by diffuse reflection "
        "and light by specular reflection at the visible surface, each one's share of B's light, its part of the "
        "bias, and its own errors");
    command
        ->add_option("--fail-above", options->failAbove,
                     "Exit with status 1 if the metric is above X (psnr: below X); may be repeated")
        ->type_name("METRIC=X")
        ->allow_extra_args(false);
    command
        ->add_option("--pixels-per-degree", options->pixelsPerDegree,
                     "Viewing condition for FLIP; 67: 0.7 m from a screen 0.7 m wide with 3840 pixels")
        ->check(inRange(1.0F, 1000.0F))
        ->capture_default_str();
    command->footer(compareFooter());
    command->callback([options] { compare(*options); });
}

}  // namespace reflet
