#include "phasefield/contour/chain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace endoflow::phasefield {

namespace {

/// Numbers points so that points within `tolerance` of each other share a number.
class PointNumbering {
  public:
    explicit PointNumbering(double tolerance) : tolerance_(tolerance) {}

    std::size_t number(const ContourPoint& point) {
        const std::int64_t i = bucket(point.r), k = bucket(point.z);
        for (std::int64_t di = -1; di <= 1; ++di)
            for (std::int64_t dk = -1; dk <= 1; ++dk)
                if (const auto found = buckets_.find({i + di, k + dk}); found != buckets_.end())
                    for (const std::size_t known : found->second)
                        if (distance_between(points[known], point) <= tolerance_) return known;
        buckets_[{i, k}].push_back(points.size());
        points.push_back(point);
        return points.size() - 1;
    }

    std::vector<ContourPoint> points;

  private:
    [[nodiscard]] std::int64_t bucket(double x) const { return std::llround(x / (2 * tolerance_)); }

    double tolerance_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> buckets_;
};

}  // namespace

std::vector<ContourChain> join_segments(const std::vector<ContourSegment>& segments, double tolerance) {
    PointNumbering numbering(tolerance);
    std::vector<std::vector<std::size_t>> neighbours;
    for (const auto& segment : segments) {
        const std::size_t a = numbering.number(segment[0]), b = numbering.number(segment[1]);
        neighbours.resize(numbering.points.size());
        if (a == b || std::count(neighbours[a].begin(), neighbours[a].end(), b) > 0) continue;
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    std::vector<ContourChain> chains;
    std::vector<char> visited(numbering.points.size(), 0);
    const auto walk = [&](std::size_t start) {
        ContourChain chain;
        for (std::size_t here = start, next; visited[here] == 0; here = next) {
            visited[here] = 1;
            chain.push_back(numbering.points[here]);
            next = here;
            for (const std::size_t candidate : neighbours[here])
                if (visited[candidate] == 0) next = candidate;
        }
        if (chain.size() > 1) chains.push_back(std::move(chain));
    };
    for (std::size_t i = 0; i < visited.size(); ++i)  // open chains start at their ends
        if (visited[i] == 0 && neighbours[i].size() == 1) walk(i);
    for (std::size_t i = 0; i < visited.size(); ++i)
        if (visited[i] == 0) walk(i);
    return chains;
}

ContourChain thin_out(const ContourChain& chain, double spacing) {
    ContourChain out;
    for (const auto& point : chain)
        if (out.empty() || distance_between(point, out.back()) >= spacing) out.push_back(point);
    if (out.back() != chain.back()) {
        if (out.size() > 1 && distance_between(chain.back(), out.back()) < spacing) out.pop_back();
        out.push_back(chain.back());
    }
    return out;
}

}  // namespace endoflow::phasefield
