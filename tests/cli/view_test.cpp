// `reflet view` on a virtual desktop, with simulated input.
#include "cli/desktop.h"

#include <chrono>
#include <filesystem>
#include <thread>

namespace reflet::view_test {

namespace {

using namespace nlohmann::literals;
using nlohmann::json;
using std::chrono::milliseconds;

class View : public DesktopTest {
protected:
    // A position in the picture, in fractions of its width and height.
    [[nodiscard]] std::array<double, 2> inPicture(double x, double y) const {
        const json at = status()["picture"];
        return {at[0].get<double>() + x * (at[2].get<double>() - at[0].get<double>()),
                at[1].get<double>() + y * (at[3].get<double>() - at[1].get<double>())};
    }
    void findSetting(const std::string& name) const {
        click("find");
        press("ctrl+a");
        type(name);
        ASSERT_TRUE(shows([&](const json& now) { return now["controls"].contains(name); }));
        press("Return");
    }
    // Takes a screenshot of this name, and compares it with the render command that the window copies.
    void isWhatRenderWrites(const std::string& screenshot) const {
        press("ctrl+s");
        EXPECT_TRUE(
            shows([&](const json& now) { return now["notice"].get<std::string>().ends_with("/" + screenshot); }));
        press("ctrl+c");
        EXPECT_TRUE(shows([](const json& now) { return now["notice"].get<std::string>().starts_with("Copied: "); }));
        const std::string copied = status()["notice"];
        const std::string command = copied.substr(std::string("Copied: reflet").size());
        const Outcome rendered = runOther("sh", {"-c", REFLET_PROGRAM + command}, environment());
        EXPECT_EQ(rendered.status, 0) << rendered.err;
        EXPECT_TRUE(read(screenshot) == read("cubes.png")) << copied;  // not EXPECT_EQ, which prints both
    }
    static bool isAdaptive(const json& now) { return now.value("/settings/diffuse/adaptive"_json_pointer, false); }
    void typeFile(const std::string& name) const {
        click("file name");
        press("ctrl+a");
        type(name);
        press("Return");
    }
};

const Arguments cubes{"builtin:cubes", "--size", "240x400", "--fresh"};

Arguments with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

// Its steps, each of which ends at rest.
class ViewWalk : public View {
protected:
    // By its checkbox, which changes the picture.
    void togglesASetting() const {
        findSetting("diffuse.adaptive");
        const bool before = isAdaptive(status());
        click("diffuse.adaptive");
        EXPECT_TRUE(shows([&](const json& now) { return isAdaptive(now) != before; }));
        EXPECT_TRUE(atRest());
    }
    void movesTheCamera() const {
        const json camera = status()["camera"];
        const auto from = inPicture(0.5, 0.5);
        drag(from[0], from[1], from[0] + 30.0, from[1] + 10.0);
        EXPECT_TRUE(shows([&](const json& now) { return now["camera"] != camera; }));
        press("r");
        EXPECT_TRUE(shows([&](const json& now) { return now["camera"] == camera; }));
        EXPECT_TRUE(atRest());
    }
    void picksAPixel() const {
        const auto ground = inPicture(0.5, 0.8);
        clickAt(ground[0], ground[1]);
        EXPECT_TRUE(shows([](const json& now) { return now.contains("picked"); }));
        const json picked = status()["picked"];
        EXPECT_GT(picked["values"]["depth"][0].get<double>(), 0.0);
        EXPECT_EQ(picked["values"]["albedo"].size(), 3U);
        ASSERT_TRUE(picked.contains("ray"));
        EXPECT_GT(picked["ray"]["samples"].get<int>(), 0);
        EXPECT_GT(picked.value("diffuse_hits", 0), 0);
        EXPECT_GT(picked.value("shadow_lookups", 0), 0);
        click("diffuse.adaptive");  // the pixel is read again with the new setting
        EXPECT_TRUE(shows([&](const json& now) { return now["picked"]["change"] > picked["change"]; }));
        EXPECT_EQ(status()["picked"]["pixel"], picked["pixel"]);
        click("focus here");
        EXPECT_TRUE(
            shows([&](const json& now) { return now["lens"]["focus_distance"] == picked["values"]["depth"][0]; }));
    }
    // The parts of the light, by their keys.
    void switchesLight() const {
        press("3");
        EXPECT_TRUE(shows([](const json& now) { return now.value("/settings/specular/rays"_json_pointer, 9) == 0; }));
        press("3");
        EXPECT_TRUE(shows([](const json& now) { return !now["settings"].contains("specular"); }));
    }
    void opensSettingsAndViews() const {
        click("open");  // without a name
        EXPECT_TRUE(shows([](const json& now) {
            return now["problem"].get<std::string>().find("type the name") != std::string::npos;
        }));

        // A settings file has names in common with views. A file that is neither says why.
        write("both.json",
              R"({"probes": {"enabled": true, "resolution": 16, "count": 1}, "composite": {"direct": false}})");
        typeFile("both.json");
        click("open");
        EXPECT_TRUE(shows([](const json& now) { return !now.value("/settings/composite/direct"_json_pointer, true); }));
        click("switch direct");
        EXPECT_TRUE(shows([](const json& now) { return !now["settings"].contains("composite"); }));
        write("sun.json", R"({"sun": {"direction": [0, -1, 0]}})");
        typeFile("sun.json");
        click("open");
        EXPECT_TRUE(shows([](const json& now) { return now["notice"] == "sun.json: view loaded"; }));
        write("typo.json", R"({"sun": {"directoin": [0, -1, 0]}})");
        typeFile("typo.json");
        click("open");
        EXPECT_TRUE(shows(
            [](const json& now) { return now["problem"].get<std::string>().find("directoin") != std::string::npos; }));
    }
    // The file browser, in the folder of the tests.
    void opensByTheBrowser() const {
        write("listed.json", R"({"tonemap": {"exposure": 1}})");
        click("browse");
        click("file listed.json");
        EXPECT_TRUE(
            shows([](const json& now) { return now.value("/settings/tonemap/exposure"_json_pointer, 0.0) == 1.0; }));
    }
    void resizes() const {
        resize(480, 300);
        EXPECT_TRUE(shows([](const json& now) { return now["window"] == json({480, 300}); }));
        EXPECT_TRUE(atRest());
        EXPECT_EQ(status()["size"], json({100, 300}));
    }
    // An invalid file is an error and the scene stays; another one opens.
    void opensScenes() const {
        write("broken.gltf", "{ \"asset\": ");
        typeFile("broken.gltf");
        click("open");
        EXPECT_TRUE(shows([](const json& now) {
            return now["problem"].get<std::string>().find("broken.gltf") != std::string::npos;
        }));
        EXPECT_EQ(status()["scene"], "builtin:cubes");
        typeFile("builtin:tilted-cube");
        click("open");
        EXPECT_TRUE(shows([](const json& now) { return now["scene"] == "builtin:tilted-cube"; }));
        EXPECT_EQ(status()["problem"], "");
        EXPECT_TRUE(atRest());
    }
};

// Over 5 s: a walk through the window, which must rest after each input.
TEST_F(ViewWalk, PassesUnderTheValidationLayers) {
    // Without history, each rest is one frame. As narrow as the window may be: frames take most of the time.
    openViewer(
        {"builtin:cubes", "--size", "96x400", "--fresh", "--validate", "--preset", "plain", "--set", "diffuse.rays=1"});
    EXPECT_EQ(status()["size"], json({96, 400}));
    EXPECT_EQ(status()["progress"], "finished");
    togglesASetting();
    movesTheCamera();
    picksAPixel();
    switchesLight();
    opensSettingsAndViews();
    opensByTheBrowser();
    resizes();
    opensScenes();
    EXPECT_TRUE(quietSuccess(quit()));
}

// Over 5 s: three of them are the pause that is measured.
TEST_F(View, RestsWhilePaused) {
    openViewer(with(cubes, {"--preset", "direct"}));
    press("space");
    EXPECT_TRUE(shows([](const json& now) { return now["paused"].get<bool>(); }));
    std::this_thread::sleep_for(milliseconds(500));
    const int rendered = status()["rendered"];
    const double used = cpuSeconds(viewer());
    std::this_thread::sleep_for(milliseconds(3000));
    EXPECT_LT(cpuSeconds(viewer()) - used, 0.05 * 3.0);
    // While paused the panels work, but only requested steps are rendered.
    findSetting("diffuse.rays");
    EXPECT_EQ(status()["rendered"], rendered);
    click("step");
    EXPECT_TRUE(shows([&](const json& now) { return now["rendered"] == rendered + 1; }));
    EXPECT_TRUE(quietSuccess(quit()));
}

// Over 5 s: opens the window three times and waits for it to rest after each input.
TEST_F(View, AScreenshotIsWhatRenderWritesAndAllComesBackTheNextTime) {
    const Arguments remembered{"builtin:cubes", "--size", "96x400"};
    // Few passes and, while `temporal` is off, one frame a rest.
    openViewer(with(remembered, {"--preset", "plain", "--set", "temporal.frames=6", "--set", "diffuse.rays=1"}));
    const json first = status()["camera"];
    findSetting("tonemap.exposure");
    click("tonemap.exposure");
    EXPECT_TRUE(shows([](const json& now) { return now["settings"].contains("tonemap"); }));
    click("tonemap.exposure reset");
    EXPECT_TRUE(shows([](const json& now) { return !now["settings"].contains("tonemap"); }));
    findSetting("diffuse.adaptive");
    click("diffuse.adaptive");
    EXPECT_TRUE(shows(isAdaptive));
    findSetting("temporal.enabled");
    click("temporal.enabled");
    EXPECT_TRUE(shows([](const json& now) { return now["settings"].contains("temporal"); }));
    isWhatRenderWrites("cubes-1.png");  // of the scene's own view, whose bits no file has
    click("temporal.enabled");
    const auto from = inPicture(0.5, 0.5);
    drag(from[0], from[1], from[0] - 40.0, from[1] + 12.0);
    EXPECT_TRUE(shows([&](const json& now) { return now["camera"] != first; }));
    EXPECT_TRUE(atRest());

    // The reference next to it, and the error between the two.
    click("compare truth");
    EXPECT_TRUE(shows(
        [](const json& now) { return now["compare"]["samples"].get<int>() >= 4 && now["compare"].contains("flip"); }));
    EXPECT_LT(status()["compare"]["flip"].get<double>(), 0.5);
    click("compare nothing");
    EXPECT_TRUE(atRest());
    isWhatRenderWrites("cubes-2.png");
    EXPECT_NE(status()["notice"].get<std::string>().find(" --orbit "), std::string::npos) << "of a camera that turned";
    const json left = status();
    EXPECT_TRUE(quietSuccess(quit()));

    openViewer(remembered);
    EXPECT_EQ(status()["camera"], left["camera"]);
    EXPECT_EQ(status()["settings"], left["settings"]);
    EXPECT_TRUE(quietSuccess(quit()));
    // The command line overrides saved state.
    openViewer(with(remembered, {"--preset", "direct", "--time", "0"}));
    EXPECT_EQ(status()["preset"], "direct");
    EXPECT_EQ(status()["camera"], first);
    EXPECT_TRUE(quietSuccess(quit()));
}

// Over 5 s: compiles shaders, and waits for the state to be saved.
TEST_F(View, CompilesShadersThatAreEditedKeepsTheLastGoodOneAndLosesNothingWithTheDisplay) {
    std::filesystem::copy(std::filesystem::path(REFLET_SOURCE) / "src", path("src"),
                          std::filesystem::copy_options::recursive);
    openViewer(with(cubes, {"--preset", "direct", "--shaders", "src"}));
    const std::string file = "src/effects/tonemap/tonemap.comp";
    const std::string good = read(file);
    write(file, good + "broken\n");
    EXPECT_TRUE(shows([](const json& now) {
        return now["shader_problem"].get<std::string>().find("tonemap.comp") != std::string::npos;
    }));
    const int rendered = status()["rendered"];
    const auto from = inPicture(0.5, 0.5);
    drag(from[0], from[1], from[0] + 40.0, from[1]);  // rendering continues
    EXPECT_TRUE(shows([&](const json& now) { return now["rendered"].get<int>() > rendered; }));
    write(file, good + "// another\n");
    EXPECT_TRUE(shows([](const json& now) {
        return now["shader_problem"].get<std::string>().empty() &&
               now["notice"].get<std::string>().find("tonemap.comp") != std::string::npos;
    }));
    EXPECT_TRUE(atRest());

    findSetting("diffuse.adaptive");
    click("diffuse.adaptive");
    EXPECT_TRUE(shows([](const json& now) { return now["settings"].contains("diffuse"); }));
    std::this_thread::sleep_for(milliseconds(2500));
    clickAt(10.0, 10.0);  // soon something is drawn again
    std::this_thread::sleep_for(milliseconds(500));
    const json settings = status()["settings"];
    EXPECT_TRUE(refused(endDesktop(), 1, {"the display is gone"}));
    openDesktop();
    openViewer({"builtin:cubes", "--size", "240x400"});
    EXPECT_EQ(status()["settings"], settings);
    EXPECT_TRUE(quietSuccess(quit()));
}

// Over 5 s: frames of this size take the time of many redraws.
TEST_F(View, AnswersWhileAFrameIsComputed) {
    openViewer({"builtin:cave", "--size", "400x400", "--fresh", "--preset", "plain"});
    // While the view moves, the picture is computed at a lower resolution, and at rest at the whole one.
    const auto from = inPicture(0.3, 0.5);
    const json still = status();
    press("5");
    drag(from[0], from[1], from[0] + 200.0, from[1]);
    EXPECT_TRUE(shows([&](const json& now) { return now["camera"] != still["camera"]; }));
    const int drawn = status()["drawn"];
    const int rendered = status()["rendered"];
    EXPECT_GT(drawn, rendered);  // panels do not wait for frames
    EXPECT_TRUE(shows([](const json& now) { return now["scale"] == 1.0 && !now["moving"].get<bool>(); }));
    EXPECT_TRUE(quietSuccess(quit()));
}

TEST_F(View, WritesAPictureOfItself) {
    EXPECT_TRUE(quietSuccess(
        run(with({"view", "--pick", "120,300", "--preset", "direct", "--window-picture", "window.png"}, cubes),
            environment())));
    const Bitmap window = readBitmap(path("window.png"));
    EXPECT_EQ(window.width, 620U);
    EXPECT_EQ(window.height, 400U);
}

TEST_F(View, SaysThatThereIsNoDisplay) {
    Variables none = environment();
    none["DISPLAY"] = "";
    none["WAYLAND_DISPLAY"] = "";
    const Outcome outcome = run({"view", "builtin:cubes"}, none);
    EXPECT_TRUE(refused(outcome, 1, {"no window can be opened", "reflet render"}));
}

}  // namespace

}  // namespace reflet::view_test
