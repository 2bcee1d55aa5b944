#include "server/agent/picture_sources.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>
#include <vector>

#include "server/agent/picture_file.hpp"
#include "server/agent/picture_folder.hpp"
#include "server/agent/streamed_pictures.hpp"
#include "server/agent/utc.hpp"
#include "server/agent/v4l2_stream.hpp"

// Pictures that a camera's own program writes or its device gives, instead of the machine.
namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;
using Clock = PictureSource::Clock;
using Taken = PictureSource::Taken;

plant::Camera small_camera() {
    plant::Camera camera;
    camera.name = "front";
    camera.width_px = 8;
    camera.height_px = 6;
    return camera;
}

cv::Mat grey(int shade, int width_px = 8) { return {6, width_px, CV_8UC1, cv::Scalar(shade)}; }

class PictureFileTest : public ::testing::Test {
protected:
    PictureFileTest() { std::filesystem::create_directories(folder_); }
    ~PictureFileTest() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& bytes) const {
        std::ofstream(path_ + ".new", std::ios::binary) << bytes;
        std::filesystem::rename(path_ + ".new", path_);
    }
    void date(Clock::duration ago) const {
        std::filesystem::last_write_time(path_,
                                         std::filesystem::file_time_type::clock::now() - ago);
    }
    static std::string png(const cv::Mat& image) {
        std::vector<std::uint8_t> bytes;
        cv::imencode(".png", image, bytes);
        return {bytes.begin(), bytes.end()};
    }
    std::string refusal(Clock::time_point from = {}) {
        const auto taken = file_.newest(from);
        return taken ? "" : taken.error().reason.code;
    }

    std::string folder_ =
        (std::filesystem::temp_directory_path() / ("pictures-" + std::to_string(::getpid())))
            .string();
    std::string path_ = folder_ + "/front.png";
    plant::Camera camera_ = small_camera();
    PictureFile file_{camera_, path_};
};

TEST_F(PictureFileTest, ANewPictureIsGivenOnceWithTheMomentOfItsDate) {
    write(png(grey(70)));
    date(100ms);
    const auto asked = Clock::now();
    const auto taken = file_.newest(asked - 500ms);
    ASSERT_TRUE(taken && *taken);
    EXPECT_EQ((*taken)->grey.at<std::uint8_t>(3, 3), 70);
    EXPECT_LT(std::chrono::abs(asked - (*taken)->exposed - 100ms), 50ms);
    const auto again = file_.newest(asked - 500ms);
    ASSERT_TRUE(again);
    EXPECT_FALSE(*again) << "it would count twice";

    write(png(grey(80)));
    date(0ms);
    const auto next = file_.newest(asked - 500ms);
    ASSERT_TRUE(next && *next);
    EXPECT_EQ((*next)->grey.at<std::uint8_t>(3, 3), 80);
}

TEST_F(PictureFileTest, OneFromBeforeItWasAskedForIsNone) {
    write(png(grey(70)));
    date(1s);
    const auto taken = file_.newest(Clock::now() - 600ms);
    ASSERT_TRUE(taken);
    EXPECT_FALSE(*taken);
    date(-5s);
    EXPECT_EQ(refusal(), "camera_silent") << "dated in the future it would be new for ever";
}

TEST_F(PictureFileTest, WhatIsMissingCutOffOrOfAnotherSizeIsSaid) {
    EXPECT_EQ(refusal(), "camera_silent");
    const auto whole = png(grey(70));
    write(whole.substr(0, whole.size() / 2));
    EXPECT_EQ(refusal(), "bad_image");
    write("");
    EXPECT_EQ(refusal(), "bad_image");
    write(png(grey(70, 16)));
    const auto wide = file_.newest({});
    ASSERT_FALSE(wide);
    EXPECT_EQ(wide.error().reason.code, "camera_wrong_size");
    EXPECT_EQ(wide.error().reason.params,
              (Params{{"camera", "front"}, {"told", "16 x 6"}, {"wanted", "8 x 6"}}));
    std::filesystem::remove(path_);
    ::mkfifo(path_.c_str(), 0600);
    EXPECT_EQ(refusal(), "camera_silent") << "and nobody waits for who writes into it";
    std::filesystem::remove(path_);
    write(whole);
    EXPECT_EQ(refusal(), "");
}

TEST_F(PictureFileTest, WhatIsReplacedAllTheTimeIsAlwaysWhole) {
    const auto dark = png(grey(10));
    const auto light = png(grey(200));
    write(dark);
    std::atomic<bool> ends = false;
    std::thread writer([&] {
        for (int i = 0; !ends; ++i) write(i % 2 == 0 ? light : dark);
    });
    int given = 0;
    for (int i = 0; i < 2000 || given < 2; ++i) {
        const auto taken = file_.newest({});
        ASSERT_TRUE(taken) << taken.error().what;
        if (!*taken) continue;
        ++given;
        const auto& image = (*taken)->grey;
        EXPECT_EQ(image.at<std::uint8_t>(0, 0), image.at<std::uint8_t>(5, 7));
    }
    ends = true;
    writer.join();
}

TEST_F(PictureFileTest, ReadsWhatASimulatedMachineWrites) {
    auto pictures = PictureFolder::open(folder_, {camera_});
    ASSERT_TRUE(pictures);
    const auto start = Clock::now();
    EXPECT_EQ(pictures->due(start, true), 0u);
    EXPECT_FALSE(pictures->due(start + 40ms, true));
    EXPECT_TRUE(pictures->due(start + 60ms, true));
    EXPECT_FALSE(pictures->due(start + 140ms, false)) << "one that stands is drawn less often";

    PictureFile file(camera_, folder_ + "/front.pgm");
    const auto exposed = utc_now() - 30ms;
    const auto then = Clock::now() - 30ms;
    pictures->write(0, grey(90), exposed);
    auto taken = file.newest(then - 10ms);
    ASSERT_TRUE(taken && *taken);
    EXPECT_EQ((*taken)->grey.at<std::uint8_t>(1, 1), 90);
    EXPECT_LT(std::chrono::abs((*taken)->exposed - then), 10ms);

    // Nothing can be written beside it any more: the old one stays.
    std::filesystem::create_directory(folder_ + "/front.pgm.new");
    pictures->write(0, grey(91), utc_now());
    taken = file.newest({});
    ASSERT_TRUE(taken);
    EXPECT_FALSE(*taken);
}

/// A camera whose frames come when the test says so.
class Film {
public:
    class Stream final : public FrameStream {
    public:
        explicit Stream(Film& film) : film_(film) {}
        Result<Taken> next() override {
            std::unique_lock lock(film_.mutex_);
            ++film_.asked_;
            film_.changed_.notify_all();
            film_.changed_.wait(lock, [&] { return !film_.frames_.empty() || film_.lost_; });
            if (film_.lost_) return camera_silent(film_.camera, "it is gone");
            Taken taken = std::move(film_.frames_.front());
            film_.frames_.pop_front();
            return taken;
        }

    private:
        Film& film_;
    };

    Result<std::unique_ptr<FrameStream>> open() {
        const std::lock_guard lock(mutex_);
        ++opened_;
        changed_.notify_all();
        if (lost_) return camera_silent(camera, "it is not there");
        return std::make_unique<Stream>(*this);
    }
    /// Whoever reads has taken all of it when it asks for more.
    void show(std::vector<Taken> frames) {
        std::unique_lock lock(mutex_);
        const int asked = asked_ + static_cast<int>(frames.size());
        for (auto& frame : frames) frames_.push_back(std::move(frame));
        changed_.notify_all();
        changed_.wait(lock, [&] { return frames_.empty() && asked_ >= asked; });
    }
    void wait_until_asked() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return asked_ > 0; });
    }
    /// The next frame fails, and it is tried in vain to open it a few times.
    void lose() {
        std::unique_lock lock(mutex_);
        const int opened = opened_ + 3;
        lost_ = true;
        changed_.notify_all();
        changed_.wait(lock, [&] { return opened_ >= opened; });
    }
    void come_back() {
        std::unique_lock lock(mutex_);
        const int asked = asked_;
        lost_ = false;
        changed_.wait(lock, [&] { return asked_ > asked; });
    }
    /// Ends a wait for a frame, so that the reader can end.
    void end() {
        const std::lock_guard lock(mutex_);
        lost_ = true;
        changed_.notify_all();
    }

    plant::Camera camera = small_camera();

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Taken> frames_;
    int asked_ = 0;
    int opened_ = 0;
    bool lost_ = false;
};

class StreamedPicturesTest : public ::testing::Test {
protected:
    StreamedPicturesTest() {
        auto opened = StreamedPictures::open([this] { return film_.open(); }, 1ms);
        if (!opened) throw std::runtime_error(opened.error().what);
        pictures_ = std::move(*opened);
        film_.wait_until_asked();
    }
    ~StreamedPicturesTest() override { film_.end(); }

    Film film_;
    std::unique_ptr<StreamedPictures> pictures_;
    const Clock::time_point start_ = Clock::now();
};

TEST_F(StreamedPicturesTest, OnlyTheNewestFrameIsKeptWithItsOwnMoment) {
    film_.show({{grey(1), start_ - 50ms, 1e-3},
                {grey(2), start_ - 30ms, 1e-3},
                {grey(3), start_ - 10ms, 1e-3}});
    const auto taken = pictures_->newest(start_ - 500ms);
    ASSERT_TRUE(taken && *taken);
    EXPECT_EQ((*taken)->grey.at<std::uint8_t>(0, 0), 3);
    EXPECT_EQ((*taken)->exposed, start_ - 10ms);
    const auto again = pictures_->newest(start_ - 500ms);
    ASSERT_TRUE(again);
    EXPECT_FALSE(*again);
}

TEST_F(StreamedPicturesTest, AFrameFromBeforeItWasAskedForIsNone) {
    film_.show({{grey(1), start_ - 10ms, 1e-3}});
    auto taken = pictures_->newest(start_);
    ASSERT_TRUE(taken);
    EXPECT_FALSE(*taken);
    film_.show({{grey(2), start_ + 1ms, 1e-3}});
    taken = pictures_->newest(start_);
    ASSERT_TRUE(taken && *taken);
    EXPECT_EQ((*taken)->grey.at<std::uint8_t>(0, 0), 2);
}

TEST_F(StreamedPicturesTest, ALostCameraIsSilentUntilItIsBack) {
    film_.show({{grey(1), start_, 1e-3}});
    film_.lose();
    const auto lost = pictures_->newest(start_ - 500ms);
    ASSERT_FALSE(lost) << "and what it saw before is gone with it";
    EXPECT_EQ(lost.error().reason.code, "camera_silent");
    film_.come_back();
    film_.show({{grey(2), start_ + 5ms, 1e-3}});
    const auto back = pictures_->newest(start_);
    ASSERT_TRUE(back && *back);
    EXPECT_EQ((*back)->grey.at<std::uint8_t>(0, 0), 2);
}

TEST(V4l2, AStampIsBelievedWhereItCanBeTrue) {
    const Clock::time_point now(100s);
    EXPECT_EQ(exposed_at(99'980, now).at, now - 20ms);
    EXPECT_LT(exposed_at(99'980, now).sigma_s, 1e-3);
    for (const double wrong_ms : {0.0, 100'500.0, 95'000.0, std::nan("")}) {
        EXPECT_EQ(exposed_at(wrong_ms, now).at, now) << wrong_ms;
        EXPECT_GT(exposed_at(wrong_ms, now).sigma_s, 1e-3);
    }
}

TEST(PictureSources, WhatCannotBeOpenedIsNamedWithItsRemedy) {
    const std::vector<plant::Camera> cameras{small_camera()};
    const auto refused = [&](const std::string& text) {
        const auto opened = open_sources({*parse_camera(text)}, cameras);
        return opened ? Error{} : opened.error();
    };
    EXPECT_EQ(refused("front=v4l2:/dev/no-video").reason.code, "camera_not_opened");
    EXPECT_NE(refused("front=v4l2:/dev/no-video").what.find("--camera front=v4l2:/dev/no-video"),
              std::string::npos);
    EXPECT_EQ(refused("front=v4l2:/dev/null").reason.code, "camera_not_opened");
    EXPECT_EQ(refused("left=file:/tmp/left.png").reason.code, "unknown_camera");
    EXPECT_NE(refused("left=file:/tmp/left.png").what.find("front"), std::string::npos);
    EXPECT_EQ(refused("front=file:/nonexistent/front.png").reason.code, "camera_no_folder");
    EXPECT_EQ(refused("front=file:/tmp/comes-later.png").what, "");
}

/// Gives what it is told to, the nth time it is asked.
class Scripted final : public PictureSource {
public:
    Result<std::optional<Taken>> newest(Clock::time_point from) override {
        asked.push_back(from);
        const int times = static_cast<int>(asked.size());
        if (times < gives_after || times == quiet) return std::nullopt;
        return Taken{grey(5), Clock::now() - age, 1e-3};
    }
    int gives_after = 1;
    int quiet = 0;
    Clock::duration age = 0ms;
    std::vector<Clock::time_point> asked;
};

class ByMachine final : public Shutter {
public:
    Result<Picture> expose(std::size_t camera, Wish) override {
        return Picture{grey(static_cast<int>(camera)), 0.25};
    }
};

class SourceShutterTest : public ::testing::Test {
protected:
    SourceShutterTest() {
        PictureSources sources(2);
        auto scripted = std::make_unique<Scripted>();
        source_ = scripted.get();
        sources[0] = std::move(scripted);
        type_.cameras = {small_camera(), small_camera()};
        shutter_.emplace(type_, std::move(sources), machine_, [this] { ++cycles_; });
    }
    plant::VehicleType type_;
    ByMachine machine_;
    Scripted* source_ = nullptr;
    std::optional<SourceShutter> shutter_;
    int cycles_ = 0;
};

TEST_F(SourceShutterTest, ACameraWithoutASourceIsTheMachines) {
    const auto picture = shutter_->expose(1, Shutter::Wish::kFromNow);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->grey.at<std::uint8_t>(0, 0), 1);
    EXPECT_EQ(picture->age_s, 0.25);
    EXPECT_TRUE(source_->asked.empty());
}

TEST_F(SourceShutterTest, StandingItWaitsForAPictureFromNowOnAndSetPointsGoOn) {
    source_->gives_after = 6;
    const auto called = Clock::now();
    const auto picture = shutter_->expose(0, Shutter::Wish::kFromNow);
    ASSERT_TRUE(picture);
    EXPECT_GE(source_->asked.front(), called);
    EXPECT_EQ(source_->asked.front(), source_->asked.back());
    EXPECT_EQ(cycles_, 5);
    EXPECT_GE(Clock::now() - called, 45ms) << "not faster than the machine's cycles";
}

TEST_F(SourceShutterTest, StandingItGivesUpSoon) {
    source_->gives_after = 1'000'000;
    const auto called = Clock::now();
    const auto picture = shutter_->expose(0, Shutter::Wish::kFromNow);
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().reason.code, "camera_silent");
    EXPECT_GE(Clock::now() - called, 500ms);
    EXPECT_GT(cycles_, 20);
}

TEST_F(SourceShutterTest, ACameraThatIsSilentIsWaitedForAgainOnceItGivesAnything) {
    source_->gives_after = 1'000'000;
    ASSERT_FALSE(shutter_->expose(0, Shutter::Wish::kFromNow));
    const auto waited = std::exchange(cycles_, 0);
    EXPECT_FALSE(shutter_->expose(0, Shutter::Wish::kFromNow));
    EXPECT_EQ(cycles_, 0) << "the first time it was " << waited;
    source_->gives_after = 0;
    source_->age = 120ms;
    source_->quiet = static_cast<int>(source_->asked.size()) + 2;
    EXPECT_TRUE(shutter_->expose(0, Shutter::Wish::kFromNow));
    EXPECT_EQ(cycles_, 1) << "that one was from before, and the next one is waited for";
}

TEST_F(SourceShutterTest, UnderWayItTakesTheNewestAndNeverWaits) {
    source_->age = 120ms;
    const auto called = Clock::now();
    const auto picture = shutter_->expose(0, Shutter::Wish::kNewest);
    ASSERT_TRUE(picture);
    EXPECT_NEAR(picture->age_s, 0.12, 0.05);
    EXPECT_LT(source_->asked.front(), called - 500ms) << "so old it may be";
    EXPECT_GT(source_->asked.front(), called - 600ms);
    source_->gives_after = 1'000'000;
    EXPECT_FALSE(shutter_->expose(0, Shutter::Wish::kNewest));
    EXPECT_EQ(source_->asked.size(), 2u);
    EXPECT_EQ(cycles_, 0);
}

}  // namespace
}  // namespace pulseline::agent
