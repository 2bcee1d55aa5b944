#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"

/// Reflectance of the white sheets that carry the markers, averaged over small pieces of floor by
/// exact area: the ground truth that detection is held against, so nothing of it is approximate.
namespace pulseline::simulation {

inline constexpr float kPaper = 0.90F;
inline constexpr float kInk = 0.05F;

/// A point of a sheet, in its units from the top left corner: right and down as printed.
struct SheetPoint {
    double x = 0;
    double y = 0;
};

/// Convex polygon of at most 10 corners, on the stack.
struct Piece {
    std::array<SheetPoint, 10> at;
    int count = 0;

    void push(SheetPoint p) { at[static_cast<std::size_t>(count++)] = p; }
    const SheetPoint& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
    double area() const;
    /// The part where nx x + ny y >= limit.
    Piece beyond(double nx, double ny, double limit) const;
    /// Area of what it has in common with a disc.
    double area_in_disc(SheetPoint centre, double radius) const;
};

/// Marker made of square cells: QR code, AprilTag. Unit: one cell.
class CellSheet {
public:
    CellSheet(plant::MarkerKind kind, const std::string& payload, bool mirrored);
    double side() const { return side_; }

    /// Equal for all corners of a piece: the piece is all of that reflectance; -1: bare floor.
    int region(SheetPoint p) const {
        if (!(p.x >= 0 && p.y >= 0 && p.x < side_ && p.y < side_)) return -1;
        return static_cast<int>(p.y) * side_ + static_cast<int>(p.x);
    }
    float reflectance(int region, float floor) const {
        return region < 0 ? floor : cells_[static_cast<std::size_t>(region)];
    }
    /// REQUIRES: a quadrilateral smaller than a cell.
    float mean(const Piece& quad, float floor) const;

private:
    int side_ = 0;
    std::vector<float> cells_;
};

/// Circular landmark on a square sheet. Unit: 1 mm of a landmark of the usual size.
class LandmarkSheet {
public:
    LandmarkSheet(int code, bool mirrored) : code_(code), mirrored_(mirrored) {}
    double side() const { return kSide; }

    int region(SheetPoint p) const;
    float reflectance(int region, float floor) const {
        return region < 0 ? floor : (region == 0 ? kPaper : kInk);
    }
    /// REQUIRES: a quadrilateral much smaller than a dot.
    float mean(const Piece& quad, float floor) const;

private:
    static constexpr double kSide = 90;
    static constexpr SheetPoint kMiddle{kSide / 2, kSide / 2};
    SheetPoint as_printed(SheetPoint p) const { return {mirrored_ ? kSide - p.x : p.x, p.y}; }
    double dark_ring_area(const Piece& quad) const;

    int code_;
    bool mirrored_;
};

}  // namespace pulseline::simulation
