// Khronos' glTF-Validator as an oracle: the loader takes what the validator calls valid, and refuses or warns of what
// it calls an error. Over what the builders make, and 200 files with one to three changes each.
#include "base/error.h"
#include "gltf_builder.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <sstream>

namespace reflet::test::gltf_validator_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

struct Difference {
    std::string_view code;
    std::string_view reason;
};
// Errors that change nothing of what is drawn, so that a warning would only be noise.
constexpr std::string_view bounds = "the loader computes bounds from the values";
constexpr std::array accepted{
    Difference{"ACCESSOR_MIN_MISMATCH", bounds},
    Difference{"ACCESSOR_MAX_MISMATCH", bounds},
    Difference{"ACCESSOR_ELEMENT_OUT_OF_M", bounds},
    Difference{"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", bounds},
    Difference{"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", bounds},
    Difference{"/min", bounds},  // of the wrong type or length
    Difference{"/max", bounds},
    Difference{"BUFFER_VIEW_TARGET_OVERRIDE", "the target of a buffer view is not read"},
    Difference{"MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", "elements without a stride can only be tightly packed"},
    Difference{"ACCESSOR_VECTOR3_NON_UNIT", "normals are normalized"},
    Difference{"ACCESSOR_WEIGHTS_NON_NORMALIZED", "weights are normalized"},
    Difference{"ACCESSOR_JOINTS_INDEX_DUPLICATE", "the weights of a joint that is named twice add up"},
};

// What is valid, and yet refused; parts of the loader's message.
constexpr std::array refused{
    Difference{"Draco data is broken", "the validator does not decode Draco"},
    Difference{"is a broken image", "the validator does not decode images"},
    Difference{"nothing is left to draw", "the validator does not draw"},
    Difference{"is neither PNG nor JPEG", "the validator only warns of an unknown image format"},
};

bool isListed(std::span<const Difference> list, std::string_view text) {
    return std::ranges::any_of(list, [&](const Difference& d) { return text.find(d.code) != std::string_view::npos; });
}

// Name of each file and its errors. Empty: the validator did not run.
std::map<std::string, std::vector<std::string>> validate(const fs::path& folder) {
    const std::string command = fmt::format("node '{}' '{}' '{}' 2>&1", REFLET_TEST_SOURCES "/unit/gltf_validator.js",
                                            REFLET_GLTF_VALIDATOR, folder.string());
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> part{};
    while (const size_t read = pipe == nullptr ? 0 : std::fread(part.data(), 1, part.size(), pipe)) {
        text.append(part.data(), read);
    }
    EXPECT_EQ(pipe == nullptr ? -1 : pclose(pipe), 0) << text;
    std::map<std::string, std::vector<std::string>> result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const size_t tab = line.find('\t');
        std::vector<std::string>& errors = result[line.substr(0, tab)];
        std::istringstream rest(tab == std::string::npos ? "no tab" : line.substr(tab + 1));
        for (std::string error; std::getline(rest, error, ';');) {
            errors.push_back(error);
        }
    }
    return result;
}

struct Verdict {
    std::string error;
    std::vector<std::string> warnings;
};

Verdict verdictOf(const fs::path& file) {
    Verdict verdict;
    try {
        verdict.warnings = load(file).warnings;
    } catch (const Error& error) {
        verdict.error = error.what();
    }
    return verdict;
}

// Minimum and maximum, which glTF wants of positions and key times.
void addBounds(GltfBuilder& b) {
    const auto bytesOf = [&](const json& view) {
        return b.bin.data() + b.document["bufferViews"][view.get<size_t>()]["byteOffset"].get<size_t>();
    };
    for (json& accessor : b.document["accessors"]) {
        if (accessor["componentType"] != floatType || accessor["type"] == "MAT4") {
            continue;
        }
        if (!accessor.contains("bufferView")) {  // Draco's square
            accessor["min"] = {0, 0, 0};
            accessor["max"] = {1, 1, 1};
            continue;
        }
        const size_t width = GltfBuilder::componentsOf(accessor["type"].get<std::string>());
        std::vector<float> values(width * accessor["count"].get<size_t>());
        std::memcpy(values.data(), bytesOf(accessor["bufferView"]), values.size() * sizeof(float));
        if (accessor.contains("sparse")) {  // everything() replaces element 2
            std::memcpy(&values[2 * width], bytesOf(accessor["sparse"]["values"]["bufferView"]), width * sizeof(float));
        }
        std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
        std::vector<float> high = low;
        for (size_t i = 0; i < values.size(); ++i) {
            low[i % width] = std::min(low[i % width], values[i]);
            high[i % width] = std::max(high[i % width], values[i]);
        }
        accessor["min"] = low;
        accessor["max"] = high;
    }
}

// bent() without its joint out of range and its weights that do not sum to 1.
GltfBuilder bentByTheBook() {
    GltfBuilder b = bent();
    const json& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    const auto offsetOf = [&](const char* semantic) {
        const json& accessor = b.document["accessors"][attributes[semantic].get<size_t>()];
        return b.document["bufferViews"][accessor["bufferView"].get<size_t>()]["byteOffset"].get<size_t>();
    };
    b.bin[offsetOf("JOINTS_0") + 1] = 0;
    const std::array<float, 12> weights{1, 0, 0, 0, 1, 0, 0, 0, 0.25F, 0.75F, 0, 0};
    std::memcpy(b.bin.data() + offsetOf("WEIGHTS_0"), weights.data(), sizeof weights);
    return b;
}

// everything() with a stride where two accessors share a view.
GltfBuilder everythingByTheBook() {
    GltfBuilder b = everything();
    b.document["bufferViews"][0]["byteStride"] = 12;
    return b;
}

std::vector<GltfBuilder> originals() {
    std::vector<GltfBuilder> all{triangle(), slider(), bentByTheBook(), everythingByTheBook()};
    std::ranges::for_each(all, addBounds);
    return all;
}

json randomValue(std::mt19937& random) {
    const std::array<json, 16> values{0,           1,  2,      3,      -1,      0.5,  255,           5126,
                                      4294967296U, "", "VEC3", "STEP", nullptr, true, json::array(), json::object()};
    return values.at(random() % values.size());
}

// Replaces, removes or repeats one value anywhere in the document, or replaces four bytes of the buffer.
void change(GltfBuilder& b, std::mt19937& random) {
    if (random() % 6 == 0) {
        const std::array<uint32_t, 4> words{0, 0x7FC00000U, 0x3F800000U, 0xFFFFFFFFU};  // 0, NaN, 1, NaN or many
        std::memcpy(&b.bin[random() % (b.bin.size() / 4) * 4], &words.at(random() % words.size()), 4);
        return;
    }
    const json flat = b.document.flatten();
    auto leaf = flat.begin();
    std::advance(leaf, random() % flat.size());
    json::json_pointer pointer(leaf.key());
    while (!pointer.parent_pointer().empty() && random() % 3 == 0) {
        pointer.pop_back();
    }
    json& parent = b.document[pointer.parent_pointer()];
    switch (random() % 4) {
        case 0:
            parent.is_array() ? parent.erase(std::stoul(pointer.back())) : void(parent.erase(pointer.back()));
            break;
        case 1:
            if (parent.is_array()) {
                parent.push_back(json(b.document[pointer]));
                break;
            }
            [[fallthrough]];
        default:
            b.document[pointer] = randomValue(random);
    }
}

TEST(GltfValidator, AgreesAboutWhatIsValid) {
    if (!fs::exists(REFLET_GLTF_VALIDATOR "/index.js")) {
        GTEST_SKIP() << "no glTF-Validator: run tests/gltf_validator.sh (needs node and npm)";
    }
    if (std::system("node --version >/dev/null 2>&1") != 0) {  // NOLINT(concurrency-mt-unsafe): one thread
        GTEST_SKIP() << "no node in PATH";
    }
    const fs::path folder = testFolder();
    std::mt19937 random(21);
    int made = 0;
    for (const GltfBuilder& original : originals()) {
        GltfBuilder(original).writeGlb(folder / fmt::format("original_{}.glb", made));
        GltfBuilder(original).writeGltf(folder / fmt::format("original_{}.gltf", made));
        for (int i = 0; i < 50; ++i) {
            GltfBuilder b = original;
            for (unsigned changes = 1 + random() % 3; changes > 0; --changes) {
                change(b, random);
            }
            b.writeGlb(folder / fmt::format("changed_{}_{}.glb", made, i));
        }
        ++made;
    }
    const auto files = validate(folder);
    ASSERT_EQ(files.size(), 208U);
    int valid = 0;
    for (const auto& [name, errors] : files) {
        const Verdict verdict = verdictOf(folder / name);
        valid += errors.empty() ? 1 : 0;
        if (errors.empty()) {
            EXPECT_TRUE(verdict.error.empty() || isListed(refused, verdict.error)) << verdict.error;
        } else if (verdict.error.empty() && verdict.warnings.empty()) {
            EXPECT_TRUE(std::ranges::all_of(errors, [](const auto& e) { return isListed(accepted, e); }))
                << name << " is neither refused nor warned of: " << fmt::format("{}", fmt::join(errors, "; "));
        }
        if (name.starts_with("original")) {
            EXPECT_TRUE(errors.empty()) << name << ": " << fmt::format("{}", fmt::join(errors, "; "));
        }
    }
    EXPECT_GT(valid, 30);
    EXPECT_GT(208 - valid, 100);
}

}  // namespace
}  // namespace reflet::test::gltf_validator_test
