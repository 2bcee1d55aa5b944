#include "server/agent/v4l2_stream.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

namespace pulseline::agent {
namespace {

using Clock = PictureSource::Clock;

constexpr double kStampSigma_s = 5e-4;
// Carried over by USB, and by a thread that others keep from running.
constexpr double kTakenOutSigma_s = 5e-3;
constexpr double kOldestStamp_s = 1;
// Frames that the driver may keep: one that is being filled, one that is being read.
constexpr int kBuffers = 2;

class V4l2Stream final : public FrameStream {
public:
    V4l2Stream(const plant::Camera& camera, cv::VideoCapture capture)
        : camera_(camera), capture_(std::move(capture)) {}

    Result<PictureSource::Taken> next() override {
        try {
            if (!capture_.grab()) return camera_silent(camera_, "its device gives no frame");
            const auto taken_out = Clock::now();
            const auto exposed = exposed_at(capture_.get(cv::CAP_PROP_POS_MSEC), taken_out);
            cv::Mat frame;
            if (!capture_.retrieve(frame)) return bad_image(camera_, "its frame is damaged");
            if (frame.type() == CV_8UC3) cv::cvtColor(frame, frame, cv::COLOR_BGR2GRAY);
            if (frame.type() != CV_8UC1) return bad_image(camera_, "it is neither grey nor colour");
            if (const auto sized = has_size(frame.size(), camera_); !sized)
                return fail(sized.error());
            return PictureSource::Taken{std::move(frame), exposed.at, exposed.sigma_s};
        } catch (const cv::Exception& error) {
            return bad_image(camera_, error.what());
        }
    }

private:
    const plant::Camera& camera_;
    cv::VideoCapture capture_;
};

tl::unexpected<Error> not_opened(const plant::Camera& camera, const std::string& device,
                                 const std::string& why) {
    return fail(Errc::kNotFound, "camera_not_opened",
                "--camera " + camera.name + "=v4l2:" + device + " is not opened: " + why +
                    "; plug it in, name its device (/dev/video0) and let this user read it",
                {}, {{"camera", camera.name}});
}

}  // namespace

Exposed exposed_at(double stamp_ms, Clock::time_point taken_out) {
    const std::chrono::duration<double> now = taken_out.time_since_epoch();
    const double age_s = now.count() - stamp_ms / 1000;
    if (!(age_s >= 0 && age_s <= kOldestStamp_s)) return {taken_out, kTakenOutSigma_s};
    const auto age = std::chrono::microseconds(std::llround(age_s * 1e6));  // as fine as stamps are
    return {taken_out - age, kStampSigma_s};
}

Result<std::unique_ptr<FrameStream>> open_v4l2(const plant::Camera& camera,
                                               const std::string& device) {
    // OpenCV would say on the terminal, every time anew, that there is none.
    if (::access(device.c_str(), R_OK | W_OK) != 0) {
        return not_opened(camera, device, std::strerror(errno));
    }
    // It waits ten seconds for a frame by itself, and nobody could end the program meanwhile.
    ::setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1", 0);
    cv::VideoCapture capture;
    try {
        capture.open(device, cv::CAP_V4L2);
    } catch (const cv::Exception& error) {
        return not_opened(camera, device, error.what());
    }
    if (!capture.isOpened()) return not_opened(camera, device, "it is no camera, or in use");
    capture.set(cv::CAP_PROP_FRAME_WIDTH, camera.width_px);
    capture.set(cv::CAP_PROP_FRAME_HEIGHT, camera.height_px);
    capture.set(cv::CAP_PROP_FPS, camera.frame_rate_hz);
    capture.set(cv::CAP_PROP_BUFFERSIZE, kBuffers);
    const cv::Size told(static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH)),
                        static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT)));
    if (const auto sized = has_size(told, camera); !sized) return fail(sized.error());
    return std::make_unique<V4l2Stream>(camera, std::move(capture));
}

}  // namespace pulseline::agent
