// SPDX-License-Identifier: Apache-2.0
// `dpctl gsd configure`: the page is opened on a desktop, and named where there is none.
#include "control/bench.hpp"
#include "dpctl/cli/cli.hpp"
#include "dpctl/cli/terminal.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace dpslave {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A machine whose xdg-open only notes what it was asked for.
class GsdConfigureCommand : public testing::Test {
protected:
    GsdConfigureCommand()
    {
        for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "PATH"}) {
            const char* value = std::getenv(name);
            before_[name] = value == nullptr ? std::nullopt : std::optional<std::string>{value};
        }
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        std::ofstream{page_} << "<!DOCTYPE html>\n";
    }
    ~GsdConfigureCommand() override
    {
        for (const auto& [name, value] : before_) {
            if (value)
                ::setenv(name.c_str(), value->c_str(), 1);
            else
                ::unsetenv(name.c_str());
        }
    }

    void has_xdg_open_that_ends_with(int exit)
    {
        const auto program = folder_.path() / "xdg-open";
        std::ofstream{program} << "#!/bin/sh\necho \"$*\" >'" << asked_.string() << "'\nexit " << exit
                               << '\n';
        ::chmod(program.c_str(), 0755);
        ::setenv("PATH", folder_.path().c_str(), 1);
    }

    int run(std::vector<std::string> more = {})
    {
        std::vector<std::string> words{"gsd", "configure", "--page", page_.string()};
        words.insert(words.end(), more.begin(), more.end());
        out.str("");
        err.str("");
        dpctl::Terminal terminal{out, err};
        return dpctl::run(words, terminal);
    }

    std::string asked() const
    {
        std::ifstream file{asked_};
        std::string line;
        std::getline(file, line);
        return line;
    }

    test::TempFolder folder_;
    std::filesystem::path page_ = folder_.path() / "configurator.html";
    std::filesystem::path asked_ = folder_.path() / "asked";
    std::map<std::string, std::optional<std::string>> before_;
    std::ostringstream out, err;
};

TEST_F(GsdConfigureCommand, OpensThePageOnADesktop)
{
    has_xdg_open_that_ends_with(0);
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        ::setenv(display, ":7", 1);

        EXPECT_EQ(run(), dpctl::kFine) << display;

        EXPECT_EQ(asked(), page_.string()) << display;
        EXPECT_THAT(out.str(), HasSubstr("The browser opens " + page_.string()));
        ::unsetenv(display);
        std::filesystem::remove(asked_);
    }
}

TEST_F(GsdConfigureCommand, NamesThePageWhereThereIsNoDesktop)
{
    has_xdg_open_that_ends_with(0);
    ::setenv("DISPLAY", "", 1);

    EXPECT_EQ(run(), dpctl::kFine);

    EXPECT_EQ(asked(), "") << "nothing is opened";
    EXPECT_THAT(out.str(), HasSubstr("There is no desktop here.\nThe page is " + page_.string() + ".\n"));
    EXPECT_THAT(out.str(), HasSubstr(":" + page_.string() + " ."));
}

TEST_F(GsdConfigureCommand, NamesThePageWhereItCannotBeOpened)
{
    ::setenv("DISPLAY", ":7", 1);
    has_xdg_open_that_ends_with(3);
    EXPECT_EQ(run(), dpctl::kNo);
    EXPECT_THAT(err.str(), HasSubstr("xdg-open could not open the page."));
    EXPECT_THAT(out.str(), HasSubstr("The page is " + page_.string()));

    std::filesystem::remove(folder_.path() / "xdg-open");
    EXPECT_EQ(run(), dpctl::kNo) << "xdg-open is not installed";
    EXPECT_THAT(out.str(), HasSubstr("The page is " + page_.string()));
}

TEST_F(GsdConfigureCommand, NamesThePackageWhereThePageIsMissing)
{
    std::filesystem::remove(page_);
    ::setenv("DISPLAY", ":7", 1);

    EXPECT_EQ(run(), dpctl::kNo);

    EXPECT_EQ(err.str(),
              "dpctl: " + page_.string() + " is not there. Install the package dpslaved-configurator.\n");
    EXPECT_EQ(out.str(), "");
}

TEST_F(GsdConfigureCommand, PrintsJson)
{
    EXPECT_EQ(run({"--json"}), dpctl::kFine);
    EXPECT_THAT(out.str(), HasSubstr("\"exit\": 0"));
    EXPECT_THAT(out.str(), HasSubstr("There is no desktop here."));
}

} // namespace
} // namespace dpslave
