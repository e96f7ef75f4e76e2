// The window's saved state: files that are broken or hostile.
#include "view/saved_state.h"
#include "base/error.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace reflet::saved_state_test {
namespace {

namespace fs = std::filesystem;

/// Keeps the state in a folder of its own.
class SavedState : public ::testing::Test {
protected:
    SavedState() : folder_(fs::path(::testing::TempDir()) / "reflet_saved_state") {
        fs::remove_all(folder_);
        ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
        state_.source.scene = "builtin:cubes";
        state_.preset = "plain";
        fs::create_directories(stateFile(state_.source.scene).parent_path());
    }
    ~SavedState() override {
        ::unsetenv("XDG_CONFIG_HOME");
        fs::remove_all(folder_);
    }

    /// The error of restoring this text, without the file's name; the state must be unchanged then.
    std::string restore(const std::string& text) {
        const fs::path file = stateFile(state_.source.scene);
        writeFileAtomically(file, text);
        const std::string before = stateText(state_);
        try {
            EXPECT_TRUE(restoreState(state_, {}));
            return "";
        } catch (const Error& error) {
            EXPECT_EQ(stateText(state_), before);
            const std::string message = error.what();
            EXPECT_LT(message.size(), 2000U);
            return message.starts_with(file.string() + ": ") ? message.substr(file.string().size() + 2) : message;
        }
    }

    ViewerState state_;

private:
    fs::path folder_;
};

TEST_F(SavedState, RestoresWhatWasSaved) {
    state_.show = "normal";
    state_.window = uvec2(800, 600);
    state_.scale = 0.5F;
    state_.compare.samples = 12;
    const std::string text = stateText(state_);
    state_ = ViewerState{.source = state_.source};
    state_.preset = "plain";
    EXPECT_EQ(restore(text), "");
    EXPECT_EQ(stateText(state_), text);
}

TEST_F(SavedState, OfAnotherVersionOrBrokenIsAnErrorThatSaysWhere) {
    EXPECT_TRUE(restore(R"({"show": {"name": "nonsense"}})").starts_with("show.name: "));
    EXPECT_TRUE(restore(R"({"show": {"name": 7}})").starts_with("show.name: must be a text"));
    EXPECT_TRUE(restore(R"({"show": 5})").starts_with("show: must be an object"));
    EXPECT_TRUE(restore(R"({"compare": {"preset": "nonsense"}})").starts_with("compare.preset: "));
    EXPECT_TRUE(restore(R"({"window": [1e99, -1]})").starts_with("window[0]: must be between 0 and 8192 pixels"));
    EXPECT_TRUE(restore(R"({"window": [800]})").starts_with("window: must be 2 numbers"));
    EXPECT_TRUE(restore(R"({"window": 1})").starts_with("window: must be 2 numbers"));
    EXPECT_TRUE(restore(R"({"scale": 1e99})").starts_with("scale: must be between 0.1 and 2"));
    EXPECT_TRUE(restore(R"({"compare": {"samples": -1}})").starts_with("compare.samples: must be between"));
    EXPECT_TRUE(restore("[]").starts_with("must be an object"));
    EXPECT_TRUE(restore(std::string(100000, '[') + std::string(100000, ']')).starts_with("is nested more than 128"));
    for (const char* text :
         {R"({"plays": 1})", R"({"preset": 1})", R"({"preset": "nonsense"})", R"({"settings": 1, "preset": "plain"})",
          R"({"view": []})", R"({"running": 3})", R"({"compare": {"with": []}})"}) {
        EXPECT_NE(restore(text), "") << text;
    }
}

TEST_F(SavedState, OfASceneWithALongNameHasAFileThatCanBeWritten) {
    const fs::path file = stateFile("/" + std::string(250, 's') + ".gltf");
    writeFileAtomically(file, "{}");
    EXPECT_TRUE(fs::exists(file));
}

TEST_F(SavedState, IsInTheHomeFolderWithAndWithoutTheVariable) {
    ::unsetenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    const std::string kept = home == nullptr ? "" : home;
    ::setenv("HOME", "/somewhere", 1);
    EXPECT_EQ(configurationFolder(), "/somewhere/.config/reflet");
    ::unsetenv("HOME");
    try {
        EXPECT_TRUE(configurationFolder().is_absolute());  // of the user database
    } catch (const Error&) {
        EXPECT_EQ(stateFile("builtin:cubes"), "/dev/null");  // a user without an entry
    }
    if (home != nullptr) {
        ::setenv("HOME", kept.c_str(), 1);
    }
}

}  // namespace
}  // namespace reflet::saved_state_test
