// What tests of wrong arguments share: a host, a view, and what an error must be.
#pragma once

#include "library/library_host.h"

#include <functional>
#include <string>

namespace reflet::test {

class Arguments : public ::testing::Test {
protected:
    Arguments() : room_(host_, {}) {
        context_ = host_.makeContext();
        const RefletViewInfo info{sizeof info, HostRoom::width, HostRoom::height, 3, 0, 0};
        EXPECT_REFLET(refletCreateView(context_, &info, &view_));
        EXPECT_REFLET(refletCreateSettings("fast", &settings_));
    }
    ~Arguments() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyView(view_);
        refletDestroyContext(context_);
        for (const std::string& message : host_.host.messages()) {
            ADD_FAILURE() << message;
        }
    }

    static void expectError(RefletResult result, const std::string& field,
                            RefletResult wanted = REFLET_ERROR_INVALID_ARGUMENT) {
        EXPECT_EQ(result, wanted) << field << ": " << refletLastError();
        EXPECT_NE(std::string(refletLastError()).find(field), std::string::npos) << field << ": " << refletLastError();
    }

    void expectFrameError(const std::string& field, const std::function<void(RefletFrameInfo&)>& spoil,
                          RefletResult wanted = REFLET_ERROR_INVALID_ARGUMENT) {
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo info = room_.frame(commands, 0);
            spoil(info);
            expectError(refletBeginFrame(view_, &info), field, wanted);
        });
    }

    void expectGBufferError(const std::string& field, const std::function<void(RefletGBuffer&)>& spoil) {
        RefletGBuffer spoiled{};
        expectFrameError(field, [&](RefletFrameInfo& info) {
            spoiled = *info.gbuffer;
            spoil(spoiled);
            info.gbuffer = &spoiled;
        });
    }

    LibraryHost host_;
    HostRoom room_;
    RefletContext context_ = nullptr;
    RefletView view_ = nullptr;
    RefletSettings settings_ = nullptr;
};

}  // namespace reflet::test
