#include "api/http/session/sign_in_request.hpp"

#include "api/http/wire/body.hpp"

namespace pulseline::api {

Result<SignIn> read_sign_in(const Request& request) {
    return read_object<SignIn>(request, [](json::ObjectReader& in) {
        SignIn credentials;
        credentials.name = in.text("name", {1, 64});
        credentials.password = in.text("password", {1, 128});
        return credentials;
    });
}

}  // namespace pulseline::api
