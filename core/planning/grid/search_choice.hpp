#pragma once

namespace pulseline::planning {

class GridMap;

/// Whether turn-jump queries on a uniform map take less time than those of the bucket search: tried
/// out on a few far pairs of cells, by counting the work of both. On floors strewn with single
/// blocked cells nearly every cell is a useful turning point of many rays, and stepping from cell
/// to cell is cheaper than jumping. Small maps are not tried: there the turn-jump search is never
/// much behind. Costs no more than the cheaper of both searches.
bool jumps_pay(const GridMap& map);

}  // namespace pulseline::planning
