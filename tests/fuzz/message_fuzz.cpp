// Any bytes as a frame of the vehicle link, read as the server reads a vehicle's and as the agent
// reads the server's.
#include <string_view>

#include "api/vda5050/frame.hpp"
#include "api/vda5050/hand_held.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "server/vehicles/vehicle_frames.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace pulseline;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    plant::Vehicle vehicle;
    vehicle.manufacturer = "Tang";
    vehicle.serial_number = "TP-01";
    (void)server::read_vehicle_frame(bytes, vehicle);
    (void)vda5050::decode_camera_frame(bytes);
    if (const auto frame = vda5050::decode_frame(bytes)) {
        (void)vda5050::decode_order(frame->payload);
        (void)vda5050::decode_instant_actions(frame->payload);
        (void)vda5050::decode_hand_frame(frame->payload);
    }
    return 0;
}
