// Makes ground truth images and caches them in a folder.
#include "measure/bench/truth.h"

#include "base/ascii.h"
#include "base/error.h"
#include "base/file.h"
#include "base/home.h"
#include "base/json.h"
#include "base/json_text.h"
#include "base/progress.h"
#include "job/fingerprint.h"
#include "job/scene_options.h"
#include "reference/sample_progress.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace reflet {

namespace {

namespace fs = std::filesystem;

// A new number invalidates the cache: to be increased when a change of the path tracer changes its images.
constexpr int referenceVersion = 1;

constexpr uint32_t chainRaysPerFrame = 16;
// Frames before accumulation starts: multi-bounce light from the previous frame has converged by then.
constexpr uint32_t chainFramesBefore = 8;

const std::array<std::string, 4> layerNames{"final", "direct", "indirect_diffuse", "indirect_specular"};

// Settings that bias an accumulated mean, as far as this build has them.
constexpr std::array<std::pair<const char*, const char*>, 8> plainSettings{{{"denoise.enabled", "false"},
                                                                            {"temporal.enabled", "false"},
                                                                            {"diffuse.downsample", "1"},
                                                                            {"specular.downsample", "1"},
                                                                            {"diffuse.reuse", "0"},
                                                                            {"specular.reuse", "0"},
                                                                            {"diffuse.adaptive", "false"},
                                                                            {"specular.adaptive", "false"}}};

const SettingEntry* findEntry(std::string_view name) {
    const auto& entries = settingEntries();
    const auto found = std::ranges::find(entries, name, &SettingEntry::name);
    return found == entries.end() ? nullptr : &*found;
}

bool isOn(const Settings& settings, std::string_view name) {
    const SettingEntry* entry = findEntry(name);
    return entry != nullptr && settingText(settings, *entry) == "true";
}

// All settings that chainSettings leaves in effect.
std::string settingsText(const Settings& settings) {
    std::string text;
    for (const SettingEntry& entry : settingEntries()) {
        if (!entry.name.starts_with("denoise.") && !entry.name.starts_with("temporal.")) {
            text += entry.name + "=" + settingText(settings, entry) + " ";
        }
    }
    return text;
}

// Fingerprint of the running program: another build may render different images.
std::string programPrint() {
    static const std::string print = [] {
        Fingerprint f;
        f.add(readFile("/proc/self/exe"));
        return f.text();
    }();
    return print;
}

ReferenceOptions referenceOptions(const TruthOptions& options, const Settings& settings) {
    ReferenceOptions reference = options.reference;
    reference.lambertOnly = settings.materials.lambertOnly != 0;
    return reference;
}

Truth traceTruth(const BenchScene& scene, uvec2 size, const ReferenceOptions& options) {
    SampleProgress progress(scene.name + ", ground truth", options, size);
    const ReferencePicture picture =
        traceReference(scene.scene, scene.view, size, options, [&](const ReferenceProgress& now) {
            progress.set(now);
            return true;
        });
    return {{{"final", picture.final},
             {"direct", picture.direct},
             {"indirect_diffuse", picture.indirectDiffuse},
             {"indirect_specular", picture.indirectSpecular}},
            "",
            picture.samples,
            picture.noise};
}

Truth renderChain(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings, uint32_t rays) {
    const uint32_t perFrame = std::min(rays, chainRaysPerFrame);
    const uint32_t frames = (rays + perFrame - 1) / perFrame;
    const Settings means = chainSettings(settings, perFrame);
    Settings before = means;
    before.accumulate.enabled = 0;
    Subject subject(device, scene, size, before);
    Progress progress(scene.name + ", ground truth: frame", chainFramesBefore + frames);
    for (uint32_t i = 0; i < chainFramesBefore; ++i) {
        subject.render();
        progress.advance();
    }
    subject.change(means);
    for (uint32_t i = 0; i + 1 < frames; ++i) {
        subject.render();
        progress.advance();
    }
    return {subject.picture({layerNames.begin(), layerNames.end()}), "", frames * perFrame, 0.0};
}

std::optional<Truth> readTruth(const fs::path& picture, const fs::path& facts) {
    if (!fs::exists(facts) || !fs::exists(picture)) {
        return std::nullopt;
    }
    try {
        const nlohmann::json json = parseJsonFile(facts);
        const JsonNode root(json, facts);
        const auto number = [&](const char* key, double most) {
            const auto value = json.is_object() ? root.find(key) : std::nullopt;
            if (!value) {
                root.complain(fmt::format("has no {}", key));
            }
            return value->number(0.0, most);
        };
        Truth truth{
            {}, picture.string(), static_cast<uint32_t>(number("samples", 4294967295.0)), number("noise", 1e30)};
        for (ImageLayer& layer : readExr(picture)) {
            truth.layers[layer.name] = std::move(layer.image);
        }
        return truth;
    } catch (const Error& error) {
        printWarning(fmt::format("{}; this cached ground truth will be made anew", error.what()));
        return std::nullopt;
    }
}

// The facts are written last: their file marks the image as complete.
void writeTruth(const Truth& truth, const std::string& key, const fs::path& facts) {
    std::vector<ImageLayer> layers;
    for (const auto& [name, image] : truth.layers) {
        layers.push_back({name, image, PixelType::float32});
    }
    writeExr(truth.file, layers);
    const nlohmann::ordered_json json{{"samples", truth.samples}, {"noise", truth.noise}, {"key", key}};
    writeFileAtomically(facts, jsonText(json, 2) + "\n");
}

void makeTruthFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        fail("{}: cannot be created: {}; choose another folder with --truth-cache", folder.string(), error.message());
    }
}

// Replaces what is not a letter or digit, for file names.
std::string plainName(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        plain += isAsciiAlphanumeric(c) ? c : '-';
    }
    return plain;
}

}  // namespace

void parseTruth(const std::string& text, TruthOptions& options) {
    constexpr std::string_view chain = "chain:";
    if (text == "none" || text == "reference") {
        options.kind = text == "none" ? TruthKind::none : TruthKind::reference;
        return;
    }
    const char* end = text.data() + text.size();
    if (text.starts_with(chain)) {
        const auto [rest, error] = std::from_chars(text.data() + chain.size(), end, options.chainRays);
        if (error == std::errc() && rest == end && options.chainRays > 0) {
            options.kind = TruthKind::chain;
            return;
        }
    }
    failUsage("--truth must be 'reference', 'none' or 'chain:RAYS' with at least 1 ray, is '{}'", text);
}

fs::path standardTruthFolder() {
    const auto cache = cacheFolder();
    return cache ? *cache / "truth" : fs::path();
}

Settings chainSettings(const Settings& settings, uint32_t raysPerFrame) {
    Settings chain = settings;
    const bool antialiased = isOn(settings, "temporal.enabled");
    for (const auto& [name, value] : plainSettings) {
        if (findEntry(name) != nullptr) {
            setSetting(chain, name, value);
        }
    }
    chain.diffuse.rays = settings.diffuse.rays == 0 ? 0 : raysPerFrame;
    chain.specular.rays = settings.specular.rays == 0 ? 0 : raysPerFrame;
    chain.accumulate.enabled = 1;
    chain.accumulate.jitter = antialiased ? 1 : 0;
    return chain;
}

std::string truthKey(const BenchScene& scene, uvec2 size, const Settings& settings, const TruthOptions& options) {
    Fingerprint seen;
    addTo(seen, scene.scene);
    addTo(seen, scene.view);
    const std::string what = fmt::format("scene {}, {}x{}", seen.text(), size.x, size.y);
    if (options.kind == TruthKind::chain) {
        const Settings chain = chainSettings(options.chainOf.value_or(settings), chainRaysPerFrame);
        return fmt::format("chain of {} rays, {}, seed {}, program {}, {}", options.chainRays, what, scene.seed,
                           programPrint(), settingsText(chain));
    }
    const ReferenceOptions reference = referenceOptions(options, settings);
    Fingerprint how;
    addTo(how, reference);
    return fmt::format("reference {}, {}, bounces {}, samples {}, visible only {}, lambert only {}, options {}",
                       referenceVersion, what, reference.bounces, reference.samples, reference.visibleOnly,
                       reference.lambertOnly, how.text());
}

Truth getTruth(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
               const TruthOptions& options) {
    if (options.kind == TruthKind::none) {
        return {};
    }
    if (options.folder.empty()) {
        failUsage("there is no home folder for the cache of ground truth: choose a folder with --truth-cache");
    }
    const std::string key = truthKey(scene, size, settings, options);
    Fingerprint print;
    print.add(key);
    const std::string name = fmt::format("{}-{}x{}-{}", plainName(scene.name), size.x, size.y, print.text());
    const fs::path picture = options.folder / (name + ".exr");
    const fs::path facts = options.folder / (name + ".json");
    if (auto kept = readTruth(picture, facts)) {
        return std::move(*kept);
    }
    makeTruthFolder(options.folder);
    Truth truth = options.kind == TruthKind::chain
                      ? renderChain(device, scene, size, options.chainOf.value_or(settings), options.chainRays)
                      : traceTruth(scene, size, referenceOptions(options, settings));
    truth.file = picture.string();
    writeTruth(truth, key, facts);
    return truth;
}

}  // namespace reflet
