#include "server/vehicle_frames.hpp"
