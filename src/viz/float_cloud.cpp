#include "viz/float_cloud.h"

namespace monarch_flight {

sensor_msgs::PointCloud2 floatCloud(const std::vector<std::string>& fields, std::size_t points,
                                    const std::string& frame, const ros::Time& stamp) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = stamp;
  cloud.header.frame_id = frame;
  for (const std::string& name : fields) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += 4;
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = true;
  cloud.data.resize(cloud.row_step);
  return cloud;
}

bool isFloatCloud(const sensor_msgs::PointCloud2& cloud, const std::vector<std::string>& fields) {
  const std::size_t step = 4 * fields.size();
  bool same = cloud.fields.size() == fields.size() && !cloud.is_bigendian && cloud.height == 1 &&
              cloud.point_step == step && cloud.data.size() == step * cloud.width;
  for (std::size_t i = 0; same && i < fields.size(); ++i) {
    const sensor_msgs::PointField& field = cloud.fields[i];
    same = field.name == fields[i] && field.offset == 4 * i &&
           field.datatype == sensor_msgs::PointField::FLOAT32;
  }
  return same;
}

}  // namespace monarch_flight
