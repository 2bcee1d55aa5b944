#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "api/http/plant/grid_png.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"
#include "tests/api/http/api_world.hpp"

namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;
using testing::Json;

TEST(Session, SignInGivesACookieThatWorksAndSignOutEndsIt) {
    ApiWorld api;
    ASSERT_TRUE(
        api.access.create_user("mei", access::Role::kOperator, "correct horse", api.world.now)
            .has_value());

    const Answer signed_in =
        api.post("/api/v1/session", R"({"name":"mei","password":"correct horse"})",
                 {{"content-type", "application/json"}});
    ASSERT_EQ(signed_in.status, 200) << signed_in.body;
    const std::string set_cookie = signed_in.header("Set-Cookie");
    EXPECT_NE(set_cookie.find("HttpOnly; SameSite=Strict; Max-Age=43200"), std::string::npos);
    const ApiWorld::Headers headers = {
        {"cookie", set_cookie.substr(0, set_cookie.find(';'))},
        {"x-pulseline-csrf", signed_in.json()["csrf_token"].get<std::string>()},
        {"host", "127.0.0.1:8080"},
        {"sec-fetch-site", "same-origin"}};

    EXPECT_EQ(api.call("GET", "/api/v1/session", "", headers).json(), signed_in.json());
    EXPECT_EQ(api.call("POST", "/api/v1/fleet/pause", "", headers).status, 202);
    EXPECT_EQ(
        api.call("POST", "/api/v1/fleet/pause", "", {{"cookie", headers.at("cookie")}}).status,
        403);
    const Answer signed_out = api.call("DELETE", "/api/v1/session", "", headers);
    EXPECT_EQ(signed_out.status, 204);
    EXPECT_NE(signed_out.header("Set-Cookie").find("Max-Age=0"), std::string::npos);
    EXPECT_EQ(api.call("GET", "/api/v1/session", "", headers).status, 401);
}

TEST(Session, OverTlsTheCookieIsHostBoundAndSecure) {
    ApiWorld api;
    api.secure = true;
    ASSERT_TRUE(api.access.create_user("mei", access::Role::kViewer, "correct horse", api.world.now)
                    .has_value());
    const Answer signed_in =
        api.post("/api/v1/session", R"({"name":"mei","password":"correct horse"})");
    const std::string cookie = signed_in.header("Set-Cookie");
    EXPECT_EQ(cookie.rfind("__Host-pulseline_session=", 0), 0U);
    EXPECT_NE(cookie.find("; Secure"), std::string::npos);
}

TEST(MarkerSheets, OfTheStationsNamedAsPdfSvgOrList) {
    ApiWorld api;
    const Answer pdf = api.get("/api/v1/marker-sheets?stations=2,3");
    ASSERT_EQ(pdf.status, 200) << pdf.body;
    EXPECT_EQ(pdf.content_type, "application/pdf");
    EXPECT_EQ(pdf.body.substr(0, 5), "%PDF-");
    EXPECT_EQ(pdf.header("Content-Disposition"), "attachment; filename=\"floor-codes.pdf\"");
    const Answer svg = api.get("/api/v1/marker-sheets?stations=2&format=svg");
    EXPECT_EQ(svg.content_type, "image/svg+xml");
    EXPECT_NE(svg.body.find("<svg"), std::string::npos);
    const Answer list = api.get("/api/v1/marker-sheets?stations=2,3&format=csv");
    EXPECT_EQ(list.body.rfind("kind,payload,size_m,x_m,y_m,up_rad\nqr,ST02-F,", 0), 0u);
    EXPECT_EQ(std::ranges::count(list.body, '\n'), 5);
}

TEST(MarkerSheets, RefuseWhatIsNotThere) {
    ApiWorld api;
    const auto refused = [&](const char* query) {
        const Answer answer = api.get(std::string("/api/v1/marker-sheets?") + query);
        return std::to_string(answer.status) + " " + answer.json()["code"].get<std::string>();
    };
    EXPECT_EQ(refused("stations=77"), "422 unknown_station");
    EXPECT_EQ(refused("stations=2,,3"), "400 wrong_type");
    EXPECT_EQ(refused("stations="), "400 wrong_type");
    EXPECT_EQ(refused("stations=2&format=docx"), "400 unknown_value");

    const auto second = std::ranges::find(api.world.plant.stations, 2, &plant::Station::number);
    second->markers.clear();
    EXPECT_EQ(refused("stations=2"), "422 no_markers");
    EXPECT_EQ(api.get("/api/v1/marker-sheets?stations=2,3&format=csv").status, 200);
    plant::Marker marker = api.world.plant.markers.front();
    for (int i = 0; i < 300; ++i) {
        marker.id = plant::MarkerId("more" + std::to_string(i));
        second->markers.push_back(marker.id);
        api.world.plant.markers.push_back(marker);
    }
    EXPECT_EQ(refused(""), "422 too_many_sheets");
    EXPECT_EQ(refused("stations=2&format=svg"), "422 too_many_sheets");
    EXPECT_EQ(api.get("/api/v1/marker-sheets?format=csv").status, 200);
    EXPECT_EQ(api.get("/api/v1/marker-sheets?stations=3&format=csv").status, 200);
}

TEST(Session, SixthSignInWithinAMinuteIsToldWhenToComeBack) {
    ApiWorld api;
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(api.post("/api/v1/session", R"({"name":"a","password":"b"})").status, 401);
    }
    const Answer sixth = api.post("/api/v1/session", R"({"name":"a","password":"b"})");
    EXPECT_EQ(sixth.status, 429);
    EXPECT_EQ(sixth.header("Retry-After"), "60");
}

TEST(Session, BearerSeesItsRoleAndHasNoSessionToEnd) {
    ApiWorld api;
    const Answer session = api.get("/api/v1/session");
    EXPECT_EQ(session.json()["role"], "operator");
    EXPECT_EQ(session.json()["csrf_token"], "");
    EXPECT_EQ(api.call("DELETE", "/api/v1/session").status, 403);
}

TEST(PlantDocument, IsCompleteAndNotSentTwice) {
    ApiWorld api;
    const Answer plant = api.get("/api/v1/plant");
    ASSERT_EQ(plant.status, 200);
    EXPECT_EQ(plant.json()["stations"].size(), api.world.plant.stations.size());
    const std::string etag = plant.header("ETag");

    for (const std::string& known : {etag, "W/" + etag, "\"x\", " + etag, std::string("*")}) {
        const Answer again = api.call("GET", "/api/v1/plant", "", {{"if-none-match", known}});
        EXPECT_EQ(again.status, 304) << known;
        EXPECT_EQ(again.body, "");
    }
    EXPECT_EQ(api.call("GET", "/api/v1/plant", "", {{"if-none-match", "\"0\""}}).status, 200);
}

TEST(GridPng, IsNorthUpWithOccupiedBlack) {
    plant::OccupancyGrid grid;
    grid.width = 3;
    grid.height = 2;
    grid.resolution_m = 1;
    grid.occupied = {1, 0, 0, 0, 0, 0};  // south-west cell

    const std::string png = grid_png(grid);
    const cv::Mat image =
        cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);

    ASSERT_EQ(image.type(), CV_8UC1);
    EXPECT_EQ(image.at<unsigned char>(1, 0), 0);
    EXPECT_EQ(cv::sum(image)[0], 5 * 255.0);
    EXPECT_EQ(grid_png({}), "");
}

TEST(Vehicles, ListOneAndTheFleetAgree) {
    ApiWorld api;
    const Answer list = api.get("/api/v1/vehicles");
    ASSERT_EQ(list.json()["items"].size(), 2U);
    const Answer one = api.get("/api/v1/vehicles/V1");
    EXPECT_EQ(one.json(), list.json()["items"][0]);
    EXPECT_EQ(one.json()["link"], "live");
    EXPECT_EQ(one.header("ETag").size(), 18U);
    EXPECT_EQ(api.get("/api/v1/fleet").json()["vehicles_live"], 2);
    EXPECT_EQ(api.get("/api/v1/stations").json()["items"].size(), 4U);
}

TEST(Vehicles, PauseInitPositionAndFleetPauseAreTaken) {
    ApiWorld api;
    const Answer paused = api.post("/api/v1/vehicles/V1/pause");
    EXPECT_EQ(paused.status, 202);
    EXPECT_EQ(paused.json()["paused"], true);
    EXPECT_EQ(paused.json()["pause"]["with_fleet"], false);
    EXPECT_EQ(paused.json()["pause"]["stands"], false) << "it has not answered yet";
    EXPECT_FALSE(paused.json()["pause"]["by"].get<std::string>().empty());
    EXPECT_EQ(
        api.post("/api/v1/vehicles/V1/init-position", R"({"x_m":20,"y_m":20,"heading_rad":-6.283})")
            .status,
        202);
    EXPECT_EQ(api.post("/api/v1/fleet/pause").json()["paused"], true);
    const Answer resumed = api.post("/api/v1/fleet/resume", R"({"vehicles":["V1","V2"]})");
    EXPECT_EQ(resumed.status, 202) << resumed.body;
}

TEST(Vehicles, CameraPictureCarriesWhenItWasTaken) {
    ApiWorld api;
    const Answer image = api.get("/api/v1/vehicles/V1/cameras/front");
    EXPECT_EQ(image.status, 200);
    EXPECT_EQ(image.content_type, "image/jpeg");
    EXPECT_EQ(image.body, "JPEG");
    EXPECT_EQ(image.header("Last-Modified"), "Sat, 21 Nov 2026 03:50:36 GMT");
}

TEST(Vehicles, ACameraPictureComesInTheStepsOfThePaper) {
    plant::Plant plant = fleet::testing::small_plant();
    plant::Camera camera;
    camera.name = "front";
    for (auto& type : plant.vehicle_types) type.cameras = {camera};
    ApiWorld api(plant);
    const std::string path = "/api/v1/vehicles/V1/cameras/front/steps/";
    EXPECT_EQ(api.get(path + "grey").code(), "no_image") << "what came is no picture";
    cv::Mat grey(camera.height_px / 2, camera.width_px / 2, CV_8U, cv::Scalar(200));
    cv::rectangle(grey, {250, 180}, {350, 280}, cv::Scalar(20), cv::FILLED);
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", grey, jpeg);
    api.images.bytes.assign(jpeg.begin(), jpeg.end());
    for (const char* step : {"grey", "edges", "corners"}) {
        const Answer answer = api.get(path + step);
        ASSERT_EQ(answer.status, 200) << step << answer.body;
        EXPECT_EQ(answer.content_type, "image/png");
        const std::vector<std::uint8_t> png(answer.body.begin(), answer.body.end());
        EXPECT_EQ(cv::imdecode(png, cv::IMREAD_UNCHANGED).size(), grey.size()) << step;
    }
    EXPECT_EQ(api.get(path + "magic").code(), "unknown_step");
    EXPECT_EQ(api.get("/api/v1/vehicles/V1/cameras/belly/steps/grey").code(), "no_image");
    EXPECT_EQ(api.get("/api/v1/vehicles/V9/cameras/front/steps/grey").code(), "unknown_vehicle");
}

TEST(ServiceHandlers, HealthReadinessMetricsAndTheDocumentAnswer) {
    ApiWorld api;
    api.identity = {};
    EXPECT_EQ(api.get("/healthz").status, 200);
    EXPECT_EQ(api.get("/readyz").status, 200);
    api.service.why_not = Error{Errc::kUnavailable, {"disk_full", {}}, "The disk is full.", {}};
    EXPECT_EQ(api.get("/readyz").status, 503);
    EXPECT_EQ(api.get("/healthz").status, 200);
    EXPECT_EQ(api.get("/metrics").status, 401);
    EXPECT_EQ(api.get("/api/v1/openapi.json").json()["openapi"], "3.1.0");
}

TEST(Problem, HasTheShapeOfRfc9457) {
    Request request;
    request.request_id = "r-9";
    const Response response =
        problem(Error{Errc::kUnreachable,
                      {"target_on_heading_line", {{"offset_m", 0.01}, {"checked", true}}},
                      "Choose linear.",
                      "/steps/0/motion_mode"},
                request);
    EXPECT_EQ(response.status, 422);
    EXPECT_EQ(Json::parse(response.body),
              (Json{{"type", "urn:pulseline:problem:target_on_heading_line"},
                    {"title", "Target on heading line"},
                    {"status", 422},
                    {"code", "target_on_heading_line"},
                    {"detail", "Choose linear."},
                    {"field", "/steps/0/motion_mode"},
                    {"params", {{"offset_m", 0.01}, {"checked", true}}},
                    {"request_id", "r-9"}}));
}

TEST(Problem, StatusFollowsFromTheKindOfError) {
    const auto status = [](Errc code) { return http_status(Error{code, {"x", {}}, "", ""}); };
    EXPECT_EQ(status(Errc::kInvalid), 422);
    EXPECT_EQ(status(Errc::kNotFound), 404);
    EXPECT_EQ(status(Errc::kConflict), 409);
    EXPECT_EQ(status(Errc::kUnreachable), 422);
    EXPECT_EQ(status(Errc::kTimeout), 504);
    EXPECT_EQ(status(Errc::kUnavailable), 503);
    EXPECT_EQ(status(Errc::kForbidden), 403);
    EXPECT_EQ(status(Errc::kUnauthenticated), 401);
    EXPECT_EQ(status(Errc::kStale), 412);
    EXPECT_EQ(status(Errc::kTooMany), 429);
    EXPECT_EQ(status(Errc::kOverloaded), 503);
    Request request;
    EXPECT_EQ(internal_error(request).status, 500);
    EXPECT_EQ(unavailable(request).status, 503);
    EXPECT_EQ(too_large(request, 262144).status, 413);
    for (const Response& response :
         {internal_error(request), unavailable(request), too_large(request, 262144)}) {
        EXPECT_EQ(testing::breach(testing::schema("Problem"), Json::parse(response.body)), "");
    }
}

TEST(Rfc3339, IsUtcWithMilliseconds) {
    EXPECT_EQ(rfc3339(time_from_ns(0)), "1970-01-01T00:00:00.000Z");
    EXPECT_EQ(rfc3339(time_from_ns(1'795'233'036'125'999'999)), "2026-11-21T03:50:36.125Z");
    EXPECT_EQ(rfc3339(time_from_ns(951'782'400'000'000'000)), "2000-02-29T00:00:00.000Z");
    EXPECT_EQ(rfc3339(time_from_ns(-1'000'000)), "1969-12-31T23:59:59.999Z");
}

}  // namespace
}  // namespace pulseline::api
