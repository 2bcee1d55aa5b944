// What the agent's program reads and writes beside its link: the queue to the server, the log of
// the truth, the command line.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/agent/options.hpp"
#include "server/agent/outbox.hpp"
#include "server/agent/truth_log.hpp"

namespace pulseline::agent {
namespace {

TEST(Outbox, NewestStateAndPictureWinAndEventsGoFirst) {
    Outbox outbox;
    outbox.put_picture("front", "picture 1");
    outbox.put_visualization("pose");
    outbox.put_state("old");
    outbox.put_state("new");
    outbox.put_picture("front", "picture 2");
    outbox.put_event("hello");
    std::vector<std::string> order;
    while (auto frame = outbox.take()) order.push_back(frame->bytes);
    EXPECT_EQ(order, (std::vector<std::string>{"hello", "new", "pose", "picture 2"}));
    EXPECT_TRUE(outbox.empty());
}

TEST(TruthLog, LastLineOfTheVehicleSurvivesATornEnd) {
    const auto path =
        std::filesystem::temp_directory_path() / ("truth-" + std::to_string(::getpid()) + ".jsonl");
    std::filesystem::remove(path);
    EXPECT_FALSE(last_true_pose(path, "TP-01"));
    {
        auto log = TruthLog::open(path);
        ASSERT_TRUE(log);
        log->write({"TP-01", {1, 2, 0.5}, true, "o", 2, 4}, 1000);
        log->write({"TP-02", {9, 9, 0}, false, "", 0, 0}, 1001);
    }
    std::ofstream(path, std::ios::app) << R"({"vehicle":"TP-01","x_m":7)";
    EXPECT_EQ(*last_true_pose(path, "TP-01"), (geometry::Pose2{1, 2, 0.5}));
    {
        auto log = TruthLog::open(path);
        ASSERT_TRUE(log);
        log->write({"TP-01", {3, 2, 0.5}, false, "o", 4, 4}, 1002);
    }
    EXPECT_EQ(*last_true_pose(path, "TP-01"), (geometry::Pose2{3, 2, 0.5}));
    std::filesystem::remove(path);
    EXPECT_EQ(TruthLog::open("/nonexistent/truth").error().reason.code, "truth_log_unwritable");
}

TEST(BeliefLog, HasNoTruthInIt) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("belief-" + std::to_string(::getpid()) + ".jsonl");
    std::filesystem::remove(path);
    {
        auto log = BeliefLog::open(path);
        ASSERT_TRUE(log);
        log->write({"TP-01", {{1, 2, 0.5}, 0.01, 0.001}, true, "o", 2, 4, 77}, 1000);
    }
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(
        line,
        R"({"base_end_seq":4,"believed":{"heading_rad":0.5,"sigma_m":0.01,)"
        R"("sigma_rad":0.001,"x_m":1.0,"y_m":2.0},"cycle":77,"last_node_seq":2,"moving":true,)"
        R"("order_id":"o","t_ms":1000,"vehicle":"TP-01"})");
    std::filesystem::remove(path);
    EXPECT_EQ(BeliefLog::open("/nonexistent/belief").error().reason.code, "belief_log_unwritable");
}

TEST(Options, ACamerasSourceIsReadOrRefused) {
    const auto device = parse_camera("front=v4l2:/dev/v4l/by-id/usb-1:2=3");
    ASSERT_TRUE(device);
    EXPECT_EQ(device->camera, "front");
    EXPECT_EQ(device->kind, CameraSource::Kind::kV4l2);
    EXPECT_EQ(device->where, "/dev/v4l/by-id/usb-1:2=3");
    const auto file = parse_camera("front left=file:/run/cameras/left.png");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->camera, "front left");
    EXPECT_EQ(file->kind, CameraSource::Kind::kFile);
    for (const char* bad : {"front", "front=", "front=/dev/video0", "front=file:", "=file:a",
                            "front=rtsp:a", ":file=a", "file:a"}) {
        EXPECT_FALSE(parse_camera(bad)) << bad;
    }
}

TEST(Options, CamerasAndBeliefNeedAMachine) {
    const auto exit_of = [](std::vector<std::string> more) {
        std::vector<std::string> words{"pulseline-agent", "--server", "ws://h",  "--vehicle", "m/s",
                                       "--token",         "t",        "--world", "w"};
        words.insert(words.end(), more.begin(), more.end());
        std::vector<char*> argv;
        for (auto& word : words) argv.push_back(word.data());
        int exit_code = 0;
        return read_options(static_cast<int>(argv.size()), argv.data(), exit_code) ? 0 : exit_code;
    };
    const std::string machine = "--machine=tcp://h:1";
    EXPECT_EQ(exit_of({machine, "--camera", "a=file:b", "--camera", "c=v4l2:d"}), 0);
    EXPECT_EQ(exit_of({"--camera", "a=file:b"}), 2);
    EXPECT_EQ(exit_of({machine, "--camera", "a=file:b", "--camera", "a=v4l2:d"}), 2);
    EXPECT_EQ(exit_of({machine, "--camera", "a:b"}), 2);
    EXPECT_EQ(exit_of({machine, "--belief-log", "b"}), 0);
    EXPECT_EQ(exit_of({"--belief-log", "b"}), 2);
}

TEST(Options, AddressesFaultsAndListsAreReadOrRefused) {
    EXPECT_EQ(parse_server("wss://host:8443/")->port, "8443");
    EXPECT_EQ(parse_server("ws://host")->port, "80");
    EXPECT_EQ(parse_server("ws://[::1]:9000")->host, "::1");
    for (const char* bad : {"http://host", "ws://", "ws://host:port", "ws://host/path:1"}) {
        EXPECT_FALSE(parse_server(bad)) << bad;
    }
    EXPECT_EQ(parse_fault("wheel=drive front@20")->part, "drive front");
    EXPECT_EQ(parse_fault("marker-lost")->after_s, 0);
    EXPECT_EQ(parse_fault("slip=back drive:0.2@3")->part, "back drive");
    EXPECT_EQ(parse_fault("slip=FL:0.2@3")->share, 0.2);
    EXPECT_EQ(parse_fault("encoder=FL")->kind, Fault::Kind::kEncoder);
    EXPECT_EQ(parse_fault("bearing=FL@5")->kind, Fault::Kind::kBearing);
    EXPECT_EQ(parse_fault("obstacle=1,-2.5@3")->place, (geometry::Point2{1, -2.5}));
    EXPECT_FALSE(parse_fault("carried=1,2,3@5")->driving);
    const auto driving = parse_fault("driving:carried=1,2,3@5");
    EXPECT_TRUE(driving->driving && driving->kind == Fault::Kind::kCarried);
    EXPECT_EQ(driving->after_s, 5);
    EXPECT_EQ(parse_fault("carried=1,-2.5,90@3")->carried,
              (geometry::Pose2{1, -2.5, radians(90.0)}));
    EXPECT_EQ(parse_fault("pit=back right@5")->kind, Fault::Kind::kPit);
    EXPECT_EQ(parse_fault("pit=back right@5")->part, "back right");
    const auto off = parse_fault("bracket-off=front left:-0.004@5");
    EXPECT_TRUE(off && off->kind == Fault::Kind::kBracketOff && off->part == "front left");
    EXPECT_EQ(off->by_m, -0.004);
    EXPECT_EQ(parse_fault("scanner-covered@5")->kind, Fault::Kind::kScannerCovered);
    EXPECT_EQ(parse_fault("transmitter-dark=tx-1@5")->kind, Fault::Kind::kTransmitterDark);
    EXPECT_EQ(parse_fault("transmitter-dark=tx-1@5")->part, "tx-1");
    for (const char* bad : {"wheel=",
                            "transmitter-dark",
                            "fire",
                            "slip=FL",
                            "slip=FL:2",
                            "slip=:0.2",
                            "encoder=",
                            "marker-lost@soon",
                            "obstacle=1",
                            "obstacle=1,2,3",
                            "carried=1,2",
                            "driving:",
                            "driving:fire",
                            "carried=1,2,nan",
                            "carried=1,2,3,",
                            "wheel=FL@-1",
                            "pit=",
                            "pit",
                            "bracket-off=front left",
                            "bracket-off=:0.1",
                            "bracket-off=FL:1",
                            "bracket-off=FL:nan",
                            "bracket-off=FL:0.1:"}) {
        EXPECT_FALSE(parse_fault(bad)) << bad;
    }
    const auto list = parse_vehicle_list("# demo\nTang/TP-01 abc\n\nTang/TP-02  def \n");
    ASSERT_TRUE(list);
    EXPECT_EQ(list->size(), 2u);
    EXPECT_EQ(list->at(1).token, "def");
    for (const char* bad : {"", "Tang/TP-01", "TP-01 abc", "Tang/TP-01 a b"}) {
        EXPECT_FALSE(parse_vehicle_list(bad)) << bad;
    }
}

}  // namespace
}  // namespace pulseline::agent
