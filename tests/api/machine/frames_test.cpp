#include "api/machine/frames.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <vector>

namespace pulseline::machine {
namespace {

std::vector<Frame> one_of_each() {
    Description description{kVersion,       "Works", 2,         {"FL", "前轮"},
                            {"front left"}, {},      {"front"}, {"front left"}};
    SetPoints points{7, Mode::kRoll, {{0.5, -0.1}, {-0.25, 1.5}}};
    Feedback feedback;
    feedback.cycle = 7;
    feedback.settled = true;
    feedback.slip_share = 0.02;
    feedback.battery_percent = 81.5;
    feedback.wheels = {{0.49, -0.1, -0.09, 31.5, "", true},
                       {-0.25, 1.5, 1.5, 22, "servo_overtemperature", false}};
    feedback.brackets = {{0.05, 22500, 22400}};
    feedback.feet = {{0.12, 70000}};
    Feedback silent = feedback;
    silent.slip_share.reset();
    Picture picture{3, 1, 0.02, 4, 2, std::string("\0\1\2\3\4\5\6\xff", 8)};
    return {Hello{},
            Hello{kVersion, 0.02, 0.2, {{"FL/steering", 8}, {"front drive/drive", 3.5}}},
            Hello{kVersion + 1, 0.01, 0.1, {}},
            description,
            points,
            SetPoints{},
            feedback,
            silent,
            Lift{5, Lift::What::kBracketHeight, 2, 0.05, 0.005},
            Lift{6, Lift::What::kRaiseFeet, {}, 0, {}},
            LiftEnded{5, LiftEnded::Outcome::kFailed, "foot_overloaded: foot front left"},
            StopLifts{},
            SwitchOff{3},
            Expose{3, 1},
            picture,
            Refused{"another program is connected"},
            Look{9},
            Scans{9, {{-2.35, 0.0044, false, {0.0F, 1.5F, 9.75F}}, {-2.35, 0.0044, true, {}}}}};
}

std::string reason(std::string_view bytes) {
    const auto frame = decode(bytes);
    return frame ? "" : frame.error().reason.code;
}

TEST(MachineFrames, ReadAsTheyWereWritten) {
    for (const Frame& frame : one_of_each()) {
        const auto bytes = encode(frame);
        const auto size = frame_size(bytes);
        ASSERT_TRUE(size && *size);
        EXPECT_EQ(**size, bytes.size());
        const auto read = decode(bytes);
        ASSERT_TRUE(read) << frame.index() << " " << read.error().what;
        EXPECT_EQ(*read, frame) << frame.index();
    }
}

TEST(MachineFrames, HaveTheBytesThatTheirPageSays) {
    EXPECT_EQ(encode(StopLifts{}), std::string("\1\0\0\0\6", 5));
    EXPECT_EQ(encode(Expose{0x01020304, 9}), std::string("\6\0\0\0\x8\4\3\2\1\x9", 10));
    const auto points = encode(SetPoints{1, Mode::kSteer, {{1.0, 0.0}}});
    EXPECT_EQ(points.substr(0, 11), std::string("\x17\0\0\0\2\1\0\0\0\1\1", 11));
    EXPECT_EQ(points.substr(11, 8), std::string("\0\0\0\0\0\0\xf0\x3f", 8));  // 1.0
}

TEST(MachineFrames, CutAnywhereAreRefusedAndNothingIsReadBehindThem) {
    for (const Frame& frame : one_of_each()) {
        const auto whole = encode(frame);
        for (std::size_t size = 4; size < whole.size(); ++size) {
            auto cut = whole.substr(0, size);
            EXPECT_EQ(reason(cut), "machine_frame_broken");
            if (whole.size() >= 256) continue;
            cut[0] = static_cast<char>(size - 4);  // so that its length says the same
            EXPECT_EQ(reason(cut), "machine_frame_broken") << frame.index() << " at " << size;
        }
        EXPECT_EQ(reason(whole + "x"), "machine_frame_broken");
    }
}

TEST(MachineFrames, WithNumbersThatAreNoneOrUnknownKindsAreRefused) {
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(reason(encode(SetPoints{1, Mode::kRoll, {{wrong, 0}}})), "machine_frame_broken");
        EXPECT_EQ(reason(encode(Hello{kVersion, wrong, 0.05, {}})), "machine_frame_broken");
    }
    Feedback feedback;
    feedback.slip_share = std::numeric_limits<double>::infinity();
    EXPECT_EQ(reason(encode(feedback)), "machine_frame_broken");
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.5F}) {
        EXPECT_EQ(reason(encode(Scans{1, {{0, 0.1, false, {1.0F, wrong}}}})),
                  "machine_frame_broken");
    }
    auto mode = encode(SetPoints{1, Mode::kRoll, {}});
    mode[9] = 3;
    EXPECT_EQ(reason(mode), "machine_frame_broken");
    auto flag = encode(Feedback{});
    flag[9] = 2;
    EXPECT_EQ(reason(flag), "machine_frame_broken");
    EXPECT_EQ(reason(std::string("\1\0\0\0\x0d", 5)), "machine_frame_broken");
    EXPECT_EQ(reason(std::string("\0\0\0\0", 4)), "machine_frame_broken");
}

TEST(MachineFrames, TooLongOrOfTooManyPartsAreRefusedBeforeTheyAreHeld) {
    EXPECT_EQ(frame_size(std::string("\1\0\0\x7f", 4)).error().reason.code,
              "machine_frame_too_long");
    auto many = encode(SetPoints{1, Mode::kRoll, {}});
    many[10] = 65;
    EXPECT_EQ(reason(many), "machine_frame_broken");
    EXPECT_EQ(*frame_size("\1\0"), std::nullopt);
    auto rays = encode(Scans{1, {{0, 0.1, false, {}}}});
    rays[28] = 0x11;  // 4,352 of them
    EXPECT_EQ(decode(rays).error().what.find("too many rays") == std::string::npos, false);
}

TEST(MachineFrames, APictureThatIsNotOfItsSizeIsRefused) {
    auto bytes = encode(Picture{1, 0, 0, 2, 2, "abcd"});
    bytes[18] = 3;  // wide, and so two bytes short
    EXPECT_EQ(reason(bytes), "machine_frame_broken");
}

}  // namespace
}  // namespace pulseline::machine
