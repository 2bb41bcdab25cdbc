#include "tools/board_fit/board_picture.hpp"

namespace azimuth {

PlotCanvas board_picture(const ImageView& image, const Chessboard& board, const std::vector<BoardSighting>& sightings,
                         const BoardSolution& solution) {
  std::vector<Residual> residuals;
  for (std::size_t k = 0; k < sightings.size(); ++k)
    for (std::size_t i = 0; i < board.corners(); ++i) {
      const Pixel& seen = sightings[k].corners[i];
      const Eigen::Vector3d at = solution.T_camera_board[k] * board.corner(i);
      if (const auto expected = solution.lens.image(at, solution.lens.axes.polar(seen).radius_px))
        residuals.push_back({seen, expected->pixel, solution.fits[k * board.corners() + i]});
    }
  return residual_picture(image, solution.lens, residuals, solution.rms_px());
}

}  // namespace azimuth
