"""Labels of Chinese makers' sheets: each alone is the value it names, and what is nobody's value is not taken."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

# By type, rows of "name = label ; label @ heading above it | name = …".
WORDINGS = {
    "articulated_dump_truck": """
        Net Power = 净功率 | Gross Power = 总功率 | Engine Power = 发动机最大输出功率
        Main Relief Pressure = 主安全阀调定压力 @ 液压系统 | Main Pump Flow = 主泵流量 @ 液压系统
        Maximum Travel Speed = 最高车速 | Overall Length = 外形尺寸（长） | Overall Length = 长 @ 外形尺寸
        Overall Width = 总宽 | Overall Width = 宽 @ 外形尺寸 | Overall Height = 驾驶室顶高度
        Overall Height = 高 @ 外形尺寸 | Ground Clearance = 最小离地间隙 | Tyre Diameter = 轮胎外径
        Hoist Cylinder Stroke = 车厢举升油缸行程 | Hoist Cylinder Bore = 车厢举升油缸内径
        Hoist Cylinder Rod Diameter = 举升油缸杆径 | Steering Cylinder Stroke = 转向油缸行程
        Steering Cylinder Bore = 转向油缸缸径 | Steering Cylinder Rod Diameter = 转向油缸杆径
        Main Pump Flow = 液压泵流量 | Rated Payload = 标称载重量 | Empty Weight = 空车总重量
        Gross Weight = 最大允许总质量 | Body Capacity Heaped = 货箱容积（堆装）
        Body Capacity Struck = 货斗容积（平装） | Body Dump Angle = 货箱倾翻角度 | Body Raise Time = 车厢举升时间
        Body Lower Time = 货箱下降时间(s) | Maximum Reverse Speed = 最高倒车速度 | Turning Radius = 最小转弯半径(m)
        Body Raised Height = 举升时最大高度 | Loading Height = 装车高度 | Dump Clearance = 卸载间隙
        Body Length Inside = 货箱内长 @ 货箱 | Body Width Inside = 货箱内侧宽度 @ 货箱
        Body Width Outside = 货箱外宽 | Body Depth Inside = 货箱深度 | Rear Overhang = 后悬
        Front Tread = 前轮轮距(mm) | Rear Tread = 后轮轮距(mm) | Approach Angle = 前接近角 | Front Overhang = 前悬距
        Articulation Angle = 最大铰接角 | Front Axle to Bogie = 前桥至中桥距离 | Bogie Axle Spacing = 中桥至后桥
        Body Capacity Heaped with Tailgate = 堆装（含后挡板） | Body Capacity Struck with Tailgate = 带尾门平装容积
    """,
    "backhoe_loader": """
        Net Power = 额定功率（净） | Gross Power = 发动机总功率 | Engine Power = 发动机输出功率
        Main Relief Pressure = 系统最高压力 @ 液压系统 | Main Pump Flow = 主泵输出流量 @ 液压系统
        Maximum Travel Speed = 最高车速 | Operating Weight = 机重 | Overall Length = 外形尺寸-长
        Overall Length = 长度 @ 外形尺寸 | Overall Width = 后轮外侧宽度 | Overall Width = 宽度 @ 外形尺寸
        Overall Height = 总高（运输状态） | Overall Height = 高度 @ 外形尺寸 | Ground Clearance = 离地间隙
        Wheelbase = 轴距 | Tyre Diameter = 轮胎直径 | Loader Lift Cylinder Stroke = 装载提升油缸行程
        Loader Lift Cylinder Bore = 装载提升油缸内径 | Loader Lift Cylinder Rod Diameter = 装载举升油缸杆径
        Loader Bucket Cylinder Stroke = 装载转斗油缸行程 | Loader Bucket Cylinder Bore = 装载翻斗油缸缸径
        Loader Bucket Cylinder Rod Diameter = 装载铲斗油缸杆径 | Boom Cylinder Stroke = 挖掘大臂油缸行程
        Boom Cylinder Bore = 挖掘端动臂油缸缸径 | Dipper Cylinder Stroke = 挖掘斗杆油缸行程
        Dipper Cylinder Bore = 斗杆油缸缸径 | Backhoe Bucket Cylinder Stroke = 挖掘铲斗油缸行程
        Backhoe Bucket Cylinder Bore = 挖斗油缸缸径 | Swing Cylinder Stroke = 回转油缸行程
        Swing Cylinder Bore = 回转油缸缸径 | Turning Radius = 转弯半径（轮胎外侧）
        Loader Hinge Pin Height = 铲斗铰点最大高度 | Loader Dump Height = 装载斗卸载高度（45°）
        Loader Dump Reach = 卸载距离 | Loader Dump Angle = 卸料角 | Loader Rollback Angle = 收斗角（地面）
        Loader Digging Depth = 装载挖掘深度 | Loader Breakout Force = 装载斗最大掘起力
        Loader Lift Arm Breakout Force = 装载举升掘起力 | Loader Bucket Width = 装载斗宽
        Loader Bucket Capacity = 斗容（装载） | Backhoe Bucket Capacity = 挖掘斗容
        Loader Raise Time = 装载举升时间 | Loader Lower Time = 下降时间 | Loader Dump Time = 铲斗卸料时间
        Loader Lift Capacity = 最大高度提升能力 | Maximum Digging Depth = 挖掘最大深度
        Maximum Reach at Ground Line = 地面最大挖掘半径 | Backhoe Loading Height = 最大装车高度
        Backhoe Operating Height = 最大挖掘高度 | Backhoe Swing Arc = 回转角度（挖掘）
        Backhoe Bucket Rotation = 挖掘斗转角 | Bucket Digging Force = 挖掘力（铲斗）
        Dipper Digging Force = 斗杆挖掘力 | Swing Pivot to Rear Axle = 回转中心到后桥中心距离
        Kingpost Clearance = 回转座离地间隙 | Stabilizer Spread = 支腿全展宽度 | Steering Angle = 最大转向角
        Front Axle Oscillation = 前桥总摆动角
    """,
    "dozer": """
        Net Power = 净输出功率 | Gross Power = 毛功率 | Engine Power = 额定功率（发动机）
        Main Relief Pressure = 液压系统压力 @ 液压系统 | Main Pump Flow = 主泵最大流量 @ 液压系统
        Maximum Travel Speed = 最高行驶速度（前进） | Operating Weight = 机器总重量
        Overall Height = 总高（至驾驶室顶） | Ground Clearance = 最小离地高度
        Blade Lift Cylinder Stroke = 提升油缸行程 | Blade Lift Cylinder Bore = 铲刀提升油缸缸径
        Blade Lift Cylinder Rod Diameter = 铲刀提升油缸活塞杆直径 | Blade Tilt Cylinder Stroke = 侧倾油缸行程
        Blade Tilt Cylinder Bore = 侧倾油缸缸径 | Blade Tilt Cylinder Rod Diameter = 铲刀倾斜油缸活塞杆直径
        Ripper Lift Cylinder Stroke = 松土油缸行程 | Ripper Lift Cylinder Bore = 松土器提升油缸缸径
        Shipping Weight = 运输重量 | Maximum Reverse Speed = 最大倒车速度 | Blade Weight = 推土铲质量
        Blade Capacity = 半U铲容量 | Blade Width = 推土铲宽度(mm) | Blade Height = 铲刀高度
        Blade Digging Depth = 最大铲土深度 | Blade Lift Height = 铲刀最大提升高度
        Maximum Blade Tilt = 推土铲最大倾斜量(mm) | Blade Tilt Angle = 侧倾角 | Blade Pitch Adjustment = 铲刀俯仰角
        Blade Angle = 推土铲回转角 | Length Without Blade = 长度（不带铲刀） | Length with Blade = 总长（带推土铲）
        Width over Trunnions = 总宽（耳轴） | Track Gauge = 履带中心距离 | Shoe Width = 履带板宽度
        Width over Tracks = 总宽（不含铲刀） | Track Length on Ground = 履带着地长度 | Track Pitch = 履带板节距
        Grouser Height = 履带筋高 | Track Shoes Each Side = 履带板数（单侧）
        Track Rollers Each Side = 每侧支重轮数量 | Carrier Rollers Each Side = 每侧托轮数
        Ground Pressure = 接地比压(MPa) | Drawbar Pull = 最大牵引力 | Ripper Penetration = 松土器入土深度 @ 松土器
        Ripper Lift Height = 最大提升高度 @ 松土器 | Ripper Penetration = 松土器最大松土深度
    """,
    "excavator": """
        Net Power = 飞轮功率 | Gross Power = 额定总功率 | Engine Power = 柴油机标定功率
        Main Relief Pressure = 液压系统工作压力 @ 液压系统 | Main Pump Flow = 液压泵最大流量 @ 液压系统
        Maximum Travel Speed = 最高行走速度 | Operating Weight = 整机工作质量 | Overall Length = 全长（运输时）
        Overall Width = 履带外宽 | Overall Height = 总高（大臂） | Ground Clearance = 最小离地间隙（底盘）
        Boom Cylinder Stroke = 动臂液压缸行程 | Boom Cylinder Bore = 动臂油缸内径
        Boom Cylinder Rod Diameter = 动臂油缸杆径 | Boom Cylinder Closed Length = 大臂油缸最小安装距
        Arm Cylinder Stroke = 斗杆液压缸行程 | Arm Cylinder Bore = 斗杆缸缸径
        Arm Cylinder Rod Diameter = 斗杆油缸活塞杆直径 | Arm Cylinder Closed Length = 斗杆油缸最小安装距
        Bucket Cylinder Stroke = 挖斗油缸行程 | Bucket Cylinder Bore = 铲斗油缸缸径
        Bucket Cylinder Rod Diameter = 铲斗油缸杆径 | Bucket Cylinder Closed Length = 铲斗油缸最短长度
        Adjust Cylinder Stroke = 可变臂油缸行程 | Adjust Cylinder Bore = 二节臂油缸缸径
        Blade Cylinder Stroke = 推铲油缸行程 | Blade Cylinder Bore = 推土板油缸缸径
        Blade Cylinder Rod Diameter = 推土铲油缸杆径 | Main Relief Pressure = 主溢流阀压力
        Swing Relief Pressure = 回转油路压力 | Travel Relief Pressure = 行走溢流压力
        Main Pump Flow = 液压主泵最大流量 | Swing Speed = 平台回转速度 | Swing Torque = 平台回转扭矩
        Travel Speed Low = 行走速度（低速） | Drawbar Pull = 最大挂钩牵引力 | Counterweight = 配重
        Bucket Weight = 铲斗重量 | Bucket Capacity = 额定斗容量 | Bucket Width = 铲斗宽度（带侧齿）
        Bucket Tip Radius = 斗齿尖半径 | Boom Length = 大臂长度 | Arm Length = 小臂长度
        Maximum Digging Depth = A 最大挖掘深度
        Maximum Digging Depth 2.44 m Level Bottom = 最大挖掘深度（平底2.44米）
        Maximum Vertical Wall Digging Depth = 垂直壁最大挖深 | Maximum Digging Height = 最大挖高
        Maximum Dumping Height = 最大卸料高度 | Minimum Dumping Height = 最低卸载高度 | Maximum Reach = 最大作业半径
        Maximum Reach at Ground Line = 地面最大挖掘半径 | Minimum Swing Radius = 最小迴轉半徑
        Tail Swing Radius = 尾端迴轉半徑 | Cab Height = 总高（至驾驶室顶部） | Height to Handrail = 护栏顶部高度
        Upperstructure Width = 上部车体宽度 | Track Length = 底盘长度 | Track Length on Ground = 履带着地长度
        Track Gauge = 履带中心距离 | Shoe Width = 标准履带板宽度 | Track Height = 履带架高度
        Counterweight Clearance = 配重离地高度 | Bucket Digging Force = 铲斗挖掘力（ISO）
        Arm Digging Force = 最大斗杆推压力 | Track Shoes Each Side = 履带板数量 | Track Rollers Each Side = 支重轮
        Carrier Rollers Each Side = 托带轮数量 | Blade Width = 推土铲宽 | Blade Height = 推铲高度
        Blade Lift Height = 推土铲最大提升高度 | Blade Digging Depth = 推土铲入土深度
        Boom Swing Angle Left = 动臂左摆角 | Boom Swing Angle Right = 动臂右偏转角度
        Ground Pressure = 平均接地比压 | Maximum Travel Speed = 最大行走速度（高速） @ 行走速度
        Travel Speed Low = 低速 @ 行走速度
    """,
    "forklift": """
        Net Power = 净功率（ISO 9249） | Gross Power = 总功率（SAE J1995） | Engine Power = 柴油机额定功率
        Main Relief Pressure = 主阀溢流压力 @ 液压系统 | Main Pump Flow = 油泵流量 @ 液压系统
        Operating Weight = 自重（含蓄电池） | Overall Length = 车体全长（带叉） | Overall Width = 车体宽
        Ground Clearance = 轴距中心处离地间隙 | Wheelbase = 前后轮中心距 | Tyre Diameter = 轮胎外直径
        Lift Cylinder Stroke = 起升缸行程 | Lift Cylinder Bore = 起升油缸内径
        Lift Cylinder Rod Diameter = 起升油缸活塞杆直径 | Free Lift Cylinder Stroke = 中间起升油缸行程
        Free Lift Cylinder Bore = 中间起升油缸缸径 | Tilt Cylinder Stroke = 门架倾斜油缸行程
        Tilt Cylinder Bore = 倾斜油缸内径 | Tilt Cylinder Rod Diameter = 倾斜油缸活塞杆直径
        Steering Cylinder Stroke = 转向油缸行程 | Steering Cylinder Bore = 转向油缸缸径
        Rated Capacity = 额定起重量(kg) | Load Center = 载荷中心c | Load Distance = 驱动轴中心至货叉前端面的距离
        Axle Load Front Laden = 满载轴荷（前） | Axle Load Front Unladen = 桥负荷 空载 前
        Mast Tilt Forward = 门架前傾角 | Mast Tilt Backward = 门架倾斜角度（后）
        Lowered Mast Height = 门架下降高度 | Free Lift Height = 自由提升高度 | Lift Height = 货叉最大起升高度
        Extended Mast Height = 门架升至最高时高度 | Overhead Guard Height = 总高（护顶架）
        Seat Height = 座椅/站立高度 | Coupling Height = 牵引销离地高度 | Length to Fork Face = 车长（到货叉垂直面）
        Ground Clearance Below Mast = 满载门架下离地间隙 | Turning Radius = 最小转弯半径
        Front Tread = 轮距（前轮） | Rear Tread = 后轮距b11 | Fork Length = 货叉长 | Fork Width = 货叉宽度
        Fork Thickness = 货叉厚 | Fork Carriage Width = 滑架宽度 | Aisle Width = 最小直角堆垛通道宽度
        Travel Speed Laden = 最大行驶速度（满载） | Travel Speed Unladen = 行驶速度，空载
        Lift Speed Laden = 门架起升速度（满载） | Lift Speed Unladen = 起升速度，无负载
        Lowering Speed Laden = 最大下降速度 满载 | Lowering Speed Unladen = 降落速度（空载）
        Drawbar Pull = 额定牵引力
    """,
    "grader": """
        Net Power = 净功率 - SAE J1349 | Gross Power = 额定功率（总） | Engine Power = 标定功率
        Main Relief Pressure = 最大工作压力 @ 液压系统 | Main Pump Flow = 液压泵额定流量 @ 液压系统
        Maximum Travel Speed = 最高速度 | Operating Weight = 整机工作质量(kg) | Overall Length = 总长（基本型）
        Overall Width = 整机宽度（轮胎外侧） | Overall Height = 驾驶室高度 | Ground Clearance = 离地间距
        Wheelbase = 前后桥轴距 | Blade Lift Cylinder Stroke = 铲刀提升油缸行程
        Blade Lift Cylinder Bore = 刮刀升降油缸缸径 | Articulation Cylinder Stroke = 车架铰接油缸行程
        Articulation Cylinder Bore = 铰接转向油缸缸径 | Side Shift Cylinder Stroke = 侧移油缸行程
        Side Shift Cylinder Bore = 铲刀侧移油缸缸径 | Maximum Reverse Speed = 最大后退速度
        Steering Angle = 前轮转向角(°) | Articulation Angle = 最大铰接角（左/右）
        Front Axle Oscillation = 前桥摆角 | Turning Radius = 最小转弯半径(外轮)(m) | Wheel Lean Angle = 前轮侧倾角
        Moldboard Length = 标准铲刀长度 | Moldboard Height = 刮刀高 | Moldboard Thickness = 铲刀板厚
        Moldboard Arc Radius = 铲刀弧度半径 | Throat Clearance = 铲刀喉口间隙 | Circle Rotation = 铲刀回转角(°)
        Circle Diameter = 回转圈外径 | Blade Lift Above Ground = 铲刀提升高度 | Depth of Cut = 铲刀入土深度 @ 铲刀
        Blade Side Shift Left = 刮刀左侧移 | Blade Side Shift Right = 铲刀右侧移量
        Shoulder Reach = 铲刀最大侧伸距离 | Bank Cut Angle = 刷坡角 | Blade Tip Angle Forward = 铲刀前倾
        Blade Tip Angle Backward = 铲刀后倾角 | Blade Pull = 最大铲刀牵引力 | Blade Down Pressure = 铲刀下压力
        Height to Top of Cylinders = 到油缸顶端高度 | Front Axle Height = 前轴中心高度
        Tandem Axle Spacing = 中后桥轴距 | Front Axle to Articulation = 前轴中心至铰接中心
        Rear Axle to Articulation = 后桥至铰接中心 | Front Axle to Moldboard = 铲基距 | Tire Centerline Width = 轮距
        Ripper Penetration = 最大松土深度 @ 松土器 | Ripper Lift Height = 最大提升高度 @ 松土器
        Depth of Cut = 铲刀切土深度
    """,
    "mobile_crane": """
        Net Power = 额定净功率（ISO 9249） | Gross Power = 最大总功率 | Engine Power = 发动机标定功率
        Main Relief Pressure = 多路阀安全阀压力 @ 液压系统 | Main Pump Flow = 系统最大流量 @ 液压系统
        Maximum Travel Speed = 最大车速 | Operating Weight = 行驶状态总重量 | Overall Length = 整车全长
        Overall Width = 车宽 | Overall Height = 车高 | Luffing Cylinder Stroke = 变幅缸行程
        Luffing Cylinder Bore = 变幅液压缸缸径 | Luffing Cylinder Rod Diameter = 变幅油缸活塞杆直径
        Telescoping Cylinder Stroke = 主臂伸缩油缸行程 | Telescoping Cylinder Bore = 伸缩油缸缸径
        Outrigger Jack Cylinder Stroke = 垂直油缸行程 | Outrigger Jack Cylinder Bore = 支腿垂直油缸缸径
        Main Relief Pressure = 系统额定压力 | Maximum Lifting Capacity = 主臂最大起重量
        Radius at Maximum Capacity = 额定幅度 | Maximum Working Radius = 最大工作幅度(m)
        Boom Length Retracted = 基本臂 | Boom Length Extended = 最长主臂(m) | Boom Sections = 主臂节数
        Boom Telescoping Time = 吊臂全伸时间 | Boom Luffing Time = 臂架起臂时间 | Boom Angle Maximum = 最大仰角
        Boom Angle Minimum = 最小仰角 | Jib Length = 副起重臂长度 | Jib Offset Angle = 副臂安装角
        Maximum Tip Height = 全伸主臂最大起升高度 | Slewing Speed = 回转转速 | Main Winch Line Speed = 主卷扬绳速
        Main Winch Line Pull = 单绳拉力 | Hoist Rope Diameter = 主卷扬绳径
        Outrigger Spread Lateral = 横向跨距（支腿） | Outrigger Spread Longitudinal = 纵向支腿跨距
        Counterweight = 配重重量 | Tail Swing Radius = 转台尾部回转半径 | Axle Load = 轴荷
        Turning Radius = 最小转弯半径 | Approach Angle = 接近角度 | Departure Angle = 离去角
        Outrigger Spread Lateral = 支腿跨距（全伸 横向） @ 支腿
        Outrigger Spread Longitudinal = 支腿跨距 纵向 @ 支腿
    """,
    "rigid_dump_truck": """
        Net Power = 最大净功率 | Gross Power = 发动机总功率（ISO 14396） | Engine Power = 最大功率
        Main Relief Pressure = 主溢流阀压力 @ 液压系统 | Main Pump Flow = 主泵额定流量 @ 液压系统
        Maximum Travel Speed = 最高行驶速度 | Overall Length = 总长度 | Overall Width = 外形尺寸-宽
        Overall Height = 运输高度 | Wheelbase = 前后轮轴距 | Hoist Cylinder Stroke = 货厢举升缸行程
        Hoist Cylinder Bore = 货箱举升油缸缸径 | Hoist Cylinder Rod Diameter = 举升油缸活塞杆直径
        Steering Cylinder Stroke = 转向缸行程 | Steering Cylinder Bore = 转向缸缸径 | Main Pump Flow = 系统流量
        Rated Payload = 额定装载量 | Empty Weight = 整机整备质量 | Gross Weight = 整车满载质量
        Body Capacity Heaped = 车厢堆装容量 | Body Capacity Struck = 货箱平装（SAE） | Body Dump Angle = 货箱倾角
        Body Raise Time = 满载举升时间 | Body Lower Time = 货厢下降时间 | Maximum Reverse Speed = 最高后退速度
        Turning Radius = 转弯半径（前轮外侧） | Body Raised Height = 总高（货箱举升）
        Loading Height = 车斗装载高度 | Dump Clearance = 卸载时尾部离地间隙 | Body Length Inside = 内部长度 @ 货箱
        Body Width Inside = 货厢内部宽度 @ 货箱 | Body Width Outside = 货箱宽度 | Body Depth Inside = 车厢深度
        Rear Overhang = 后悬长度 | Front Tread = 轮距 前 | Rear Tread = 轮距（后轮） | Body Weight = 车厢重量
        Chassis Weight = 底盘重量 | Operating Width = 操作宽度 | Canopy Width = 护檐宽度
        Front Canopy Height = 总高（货箱前檐） | Body Length Overall = 货箱长度
        Rear Axle Clearance = 后桥包离地间隙 | Engine Guard Clearance = 发动机护板离地间隙
    """,
    "skid_steer": """
        Net Power = 净功率（GB/T 16936） | Gross Power = 发动机毛功率 | Engine Power = 额定输出功率
        Main Relief Pressure = 工作系统压力 @ 液压系统 | Main Pump Flow = 泵最大流量 @ 液压系统
        Operating Weight = 整机重量 | Overall Width = 轮胎外宽 | Overall Height = 至驾驶室顶部高度
        Wheelbase = 前后轴距 | Lift Cylinder Stroke = 提升油缸行程 | Lift Cylinder Bore = 举升油缸内径
        Lift Cylinder Rod Diameter = 大臂油缸杆径 | Tilt Cylinder Stroke = 翻斗油缸行程
        Tilt Cylinder Bore = 翻斗油缸缸径 | Tilt Cylinder Rod Diameter = 铲斗油缸活塞杆直径
        Main Relief Pressure = 系统压力 | Main Pump Flow = 工作泵流量
        Hinge Pin Height at Maximum Lift = 最高铰接销高度 | Dumping Clearance = 卸载高度（最大）
        Dumping Reach = 最大卸载高度时卸载距离 | Dump Angle at Maximum Lift = 最大举升高度卸载角
        Rack Back at Ground = 地面后倾角 | Digging Depth = 铲斗下挖深度 | Breakout Force = 铲斗挖掘力
        Lift Arm Breakout Force = 举升力 | Bucket Width = 总宽（带铲斗） | Bucket Capacity = 堆装斗容
        Raise Time = 举升时间 @ 循环时间 | Lower Time = 动臂下降时间 @ 循环时间 | Dump Time = 前倾时间 @ 循环时间
        Rated Operating Capacity = 额定工作载荷(kg) | Tipping Load = 倾翻负荷 | Length with Bucket = 全长（带铲斗）
        Length Without Attachment = 整机长度（不带铲斗） | Turning Radius with Bucket = 前端转弯半径
        Turning Radius Rear = 后部回转半径 | Departure Angle = 离去角度
        Operating Height Fully Raised = 最大举升总高 | Auxiliary Flow = 标准流量
    """,
    "wheel_loader": """
        Net Power = 飞轮净功率 | Engine Power = 引擎功率 | Main Relief Pressure = 主溢流阀调定压力 @ 液压系统
        Main Pump Flow = 液压系统流量 @ 液压系统 | Operating Weight = 操作重量（标准配置）
        Overall Length = 总长（斗平放地面）（mm） | Lift Cylinder Stroke = 动臂缸行程
        Tilt Cylinder Stroke = 转斗缸行程 | Steering Cylinder Stroke = 转向油缸冲程
        Lift Cylinder Bore = 举升油缸缸径 | Tilt Cylinder Bore = 转斗缸径 | Steering Cylinder Bore = 转向油缸缸径
        Lift Cylinder Rod Diameter = 动臂油缸杆径 | Tilt Cylinder Rod Diameter = 转斗缸活塞杆直径
        Steering Cylinder Rod Diameter = 转向油缸活塞杆直径 | Lift Cylinder Closed Length = 动臂油缸最小安装距
        Tilt Cylinder Closed Length = 转斗油缸最小安装距 | Steering Cylinder Closed Length = 转向油缸缩回长度
        Main Relief Pressure = 工作系统压力 | Steering Relief Pressure = 转向系统最大压力
        Main Pump Flow = 主泵流量 | Steering Pump Flow = 转向泵最大流量 | Raise Time = 动臂提升时间 @ 循环时间
        Dump Time = 卸载 @ 循环时间 | Lower Time = 下降时间（空载） @ 循环时间
        Total Cycle Time = 三项和 @ 循环时间 | Bucket Weight = 标准斗重量 | Counterweight Weight = 后配重
        Static Tipping Load Straight = 倾翻载荷（直线位置） | Static Tipping Load Full Turn = 倾翻载荷-全转向
        Breakout Force = 最大掘起力 | Rimpull = 牵引力 | Maximum Travel Speed = 车速（最高）
        Maximum Steering Angle = 最大转向角（°） | Steering Angle = 铰接转向角 | Rear Axle Oscillation = 车桥摆动
        Rear Axle Oscillation Each Way = 后桥摆动角± | Wheelbase = 軸距 | Tread = 轮距（前轮/后轮）
        Hinge Pin Height at Maximum Lift = 铰销中心最大高度 | Hinge Pin Height at Carry = 铰销运输高度
        Rack Back at Ground = 着地收斗角 | Rack Back at Carry = 铲斗收斗角（运输位置）
        Rack Back at Maximum Lift = 举升最高时收斗角 | Dump Angle at Maximum Lift = 举升最高时卸载角
        Dumping Clearance = 卸载高度（铲斗45°） | Dumping Reach = 最大举升高度卸载距离
        Lift Arm Clearance at Maximum Lift = 最大提升高度时提升臂间隙 | Digging Depth = 铲斗下切深度
        Overall Length Without Bucket = 不带铲斗的总长度 | Overall Height = 總高
        Overall Operating Height = 动臂最高时总高 | Overall Width = 车体宽度（轮胎外侧）
        Bucket Width = 机宽（铲斗外侧） | Ground Clearance = 离地间隙（最低点） | Hitch Height = 牵引装置高度
        Height to Top of Stack = 至排气管顶高度 | Axle Height = 车轴中心离地高度 | Rear Overhang = 后悬距
        Rear Axle to Hitch = 后车轴中心线到连接装置的距离 | Turning Radius = 轮胎外缘转弯半径
        Bucket Capacity Heaped = 堆尖斗容 | Bucket Capacity Struck = 铲斗容量（平装） | Tyre Width = 轮胎断面宽度
        Total Cycle Time = 液压循环时间合计 @ 液压系统 | Raise Time = 动臂举升时间(s) @ 液压系统
        Lower Time = 动臂下降时间(s) @ 液压系统 | Dump Time = 斗前倾时间 @ 液压系统
    """,
}
OTHERS = {
    "articulated_dump_truck": """
        120 mm = 缸径 @ 发动机 | 132 mm = 气缸直径 | 12 L = 发动机排量 | 7 m³ = 空气流量
        320 L = 燃油箱容积 ; 燃油箱容量 | 900 Nm = 最大扭矩 @ 发动机 | 2.5 kW = 起动机功率 | 5.5 kW = 起动机
        3.9 MPa = 先导压力 | 12 MPa = 制动系统压力 | 350 kPa = 轮胎气压 | 40 L/min = 先导泵流量 | 12 km/h = 前进一档
        30 ° = 爬坡能力 | 15000 kg = 前桥负荷（空载） ; 空载前桥 ; 轮胎总成重量 | 45 ° = 驾驶室倾翻角 ; 摆动角
        30 m³ = 煤斗容积 | 12 m = 车体通过圆半径X ; 制动距离 ; 转弯半径（车体外侧）
        2500 mm = 尾门高度 ; 驾驶室宽度 ; 发动机罩高度 | 20 mm = 底板厚度 ; 前板厚度
        150 mm = 前悬挂油缸行程 ; 悬架行程 ; 悬挂油缸缸径 | 14 s = 动力下降至怠速时间
        40000 kg = 前桥允许载荷 ; 满载前桥 ; 后轴荷（满载） | 12 s = 满载制动时间 | 3000 mm = 车斗长度差
    """,
    "backhoe_loader": """
        120 mm = 活塞行程 @ 发动机 | 132 mm = 气缸行程 | 12 L = 排量 | 320 L = 燃油箱
        900 Nm = 发动机最大扭矩 @ 发动机 | 2.5 kW = 起动马达 | 5.5 kW = 起动功率 | 3.9 MPa = 先导系统压力
        12 MPa = 制动压力 | 350 kPa = 充气压力 | 40 L/min = 风扇泵流量 | 12 km/h = 前进1档 | 30 ° = 最大爬坡度
        75 kg = 司机重量 | 500 kg = 最大拖挂质量 ; 轮胎重量 | 2200 mm = 收起时支腿宽度 ; 支腿运输宽度 ; 后轮轮距
        3500 kg = 斗杆举升能力 ; 后桥载荷 ; 动臂举升能力（挖掘）
        4800 mm = 挖掘深度（伸缩斗杆伸出） ; 最大挖掘深度（伸缩臂伸出） | 300 mm = 支腿离地间隙
        40 kN = 动臂举升力（挖掘端） ; 斗杆举升力 | 5000 mm = 转弯半径（制动） ; 铲斗外侧转弯半径
        20 ° = 支腿调平角 ; 离去角 ; 接近角
    """,
    "dozer": """
        120 mm = 行程 @ 发动机 | 132 mm = 发动机缸径 | 12 L = 机油容量 | 320 L = 液压油箱容量
        900 Nm = 额定扭矩 @ 发动机 | 2.5 kW = 发电机功率 | 3.9 MPa = 先导泵压力 | 12 MPa = 转向系统先导压力
        350 kPa = 前轮胎压 | 40 L/min = 制动泵流量 | 12 km/h = Ⅱ档 | 30 ° = 爬坡角度 | 75 kg = 操作人员
        500 kg = 牵引质量 ; 驾驶室重量 | 4000 mm = 履带长度 ; 转弯半径 ; 最小转弯半径
        1200 mm = 引导轮直径 ; 梁宽 ; 松土器横梁宽度 | 2.6 m² = 接地面积 | 100 kN = 撬起力 ; 铲刀下压力 ; 撬入力
        3000 kg = 单齿松土器重量 ; 松土器重量 ; 绞盘重量 | 350 mm = 履带板厚度
        55 ° = 切削角 ; 松土齿角度 ; 铲刀切削角 | 3 = 变速箱档位数 ; 齿数 ; 松土齿数
        0.25 m/s = 铲刀提升速度 ; 推土铲提升速度 ; 铲刀下降速度 | 2000 mm = 铲刀到履带距离 ; 松土器工作宽度
        60 ° = 切削角(°) | 12 m/h = 提升速度
    """,
    "excavator": """
        120 mm = 缸径×行程 @ 发动机 | 132 mm = 发动机行程 | 12 L = 冷却液 | 320 L = 液压油箱
        900 Nm = 最大净扭矩 @ 发动机 | 2.5 kW = 空调制冷量 | 3.9 MPa = 控制油压力 | 12 MPa = 风扇系统压力
        40 L/min = 燃油流量 | 12 km/h = 二档 | 30 ° = 最大爬坡能力 | 500 kg = 附加配重
        2900 mm = 机棚高度 @ 外形尺寸 ; 发动机罩高度 @ 外形尺寸 ; 发动机盖高度 @ 外形尺寸
        2500 mm = 平台高度 ; 驾驶室宽度 ; 驱动轮直径 | 5000 mm = 抓斗高度 ; 最大卸载半径 ; 最大挖掘高度时半径
        34 MPa = 破碎锤压力 ; 增压时压力 ; 动臂举升压力 | 5.6 MPa = 先导控制压力 ; 先导油路
        150 kN = 铲斗挖掘力（增力） ; 破碎力 ; 回转制动力 | 1500 kg = 拆卸配重后重量 ; 动臂重量 ; 起重能力
        60 L/min = 回转泵流量 ; 破碎管路流量 ; 辅助管路流量 | 4.1 km/h = 中速 ; 中速行走速度
        2100 mm = 运输宽度（拆除履带） ; 推土铲到回转中心距离 ; 履带内侧间距
        3.2 L = 回转减速机 ; 终传动 ; 行走减速机 | 15 m³ = 空调风量
        6000 mm = 动臂运输长度 ; 抓取半径 ; 最大卸载半径 | 200 mm = 履带板筋高 ; 履带板节距
        35 ° = 爬坡能力 ; 最大爬坡角 | 12 t = 起吊能力 ; 最大吊重 | 200 L/min = 破碎锤流量 ; 属具流量 ; 辅助流量
    """,
    "forklift": """
        132 mm = 气缸缸径 | 12 L = 油底壳 | 320 L = 冷却系统容量 | 900 Nm = 最大输出扭矩 @ 发动机
        2.5 kW = 启动电机功率 | 12 MPa = 蓄能器压力 | 40 L/min = 冷却泵流量 | 12 km/h = 后退Ⅰ档 | 30 ° = 最大侧坡角
        3000 kg = 门架重量 ; 附加配重重量 ; 蓄电池重量 | 1200 mm = 托盘宽度 ; 货叉间距 ; 后悬距
        16 MPa = 属具压力 ; 属具工作压力 | 10 kN = 牵引力（空载） ; 空载牵引力
        14 kW = 行走电机功率 ; 驱动电机功率 ; 起升电机功率 | 0.5 m/s = 伸缩速度 ; 倾斜速度
        1100 mm = 内转弯半径 ; 内侧转弯半径 ; 叉车宽度（双胎） | 20 % = 最大爬坡度（满载）
        3500 mm = 直角通道（90°交叉） ; 交叉通道宽度 ; 直角转弯通道宽度
        2500 mm = 三级门架起升高度（选装） ; 转弯直径 | 500 kg = 货叉重量 ; 驾驶员重量
        600 mm = 轮胎断面宽度 ; 电池箱长度 ; 电池箱宽度 | 1000 mm = 货叉最大间距 ; 货叉外侧宽度 ; 挡货架高度
        48 kN = 门架起升力
    """,
    "grader": """
        132 mm = 柴油机缸径 | 320 L = 柴油箱 | 12 MPa = 变速箱压力 | 40 L/min = 先导齿轮泵流量 | 12 km/h = 后退1档
        30 ° = 最大坡度 ; 铲刀切削角 ; 牵引架摆动角 | 75 kg = 燃油重量 | 500 kg = 选装配重
        3.0 m = 总长（含松土器） ; 前推土板宽度 ; 推土板长度 | 250 mm = 松土齿间距 ; 刀片宽度 ; 前推土板提升高度
        500 mm = 平衡箱宽度 ; 回转圈侧移 ; 牵引架侧移 | 15 ° = 平衡箱摆动角 ; 平衡箱摆角
        5000 kg = 后桥负荷 ; 前轮分配质量 ; 松土器质量 | 60 kN = 松土器撬起力 ; 松土器入土力 ; 推土板推力
        20 MPa = 制动系统压力 ; 转向系统压力 | 2000 mm = 平衡箱长度 ; 牵引架长度 ; 除雪铲宽度 | 18 ° = 前桥侧倾角
    """,
    "mobile_crane": """
        132 mm = 制动盘直径 | 320 L = 变速箱油 | 12 MPa = 行车制动压力 | 12 km/h = 前进 一档
        4000 kg = 副钩起重量 ; 主吊钩质量 ; 行驶状态前桥轴荷 | 12000 mm = 臂端转弯半径 ; 副臂最大起升高度 ; 底盘长度
        50 m = 主臂＋副臂起升高度 ; 副臂起升高度 ; 主臂+副臂长度
        20 kN = 钢丝绳破断拉力 ; 副起升单绳拉力 ; 支腿反力
        2 m/s = 副卷扬单绳速度 ; 副起升单绳速度 ; 下降绳速（副卷扬）
        20 s = 主臂缩回时间 ; 主臂落臂时间 ; 垂直支腿伸出时间 | 180 m = 绳长 ; 钢丝绳长度 ; 主卷扬钢丝绳长度
        2400 mm = 后悬 ; 轴距 ; 轮距 | 4500 mm = 支腿跨距（横向，半伸） ; 支腿中间伸出横向跨距 ; 半伸支腿横向跨距
        1100 Nm = 最大力矩 @ 发动机 | 4 = 缸数 ; 支腿数量 ; 轴数
        40 t = 副臂最大额定起重量 ; 臂端单滑轮起重量 ; 副臂额定起重量
        30 m = 副臂工况起升高度 ; 副臂最大工作幅度 ; 主卷扬钢丝绳长
        60 s = 变幅时间（落臂） ; 支腿收放时间（水平） ; 全程缩臂时间
        10 m = 底盘长 ; 配重处转弯半径 ; 臂头转弯半径
    """,
    "rigid_dump_truck": """
        132 mm = 离合器片直径 | 320 L = 液压系统加油量 | 12 MPa = 散热系统压力
        15000 kg = 满载后桥 ; 衬板重量 ; 后桥载荷 | 45 ° = 离去角 | 30 m³ = 货箱容积（3:1堆装）
        12 m = 转弯半径（机体） ; 转弯直径 ; 通道圆直径 | 2500 mm = 轮胎宽度 | 20 mm = 货箱底板厚度 ; 侧板厚度
        150 mm = 前悬架行程 ; 后悬挂油缸行程 ; 制动盘厚度 | 14 s = 转向时间 | 40000 kg = 空车后桥 ; 后桥允许载荷
    """,
    "skid_steer": """
        320 L = 尿素箱容量 | 500 kg = 货叉重量 | 120 L/min = 大流量液压 ; 高流量 ; 辅助高流量
        1500 mm = 前端转弯半径（不带铲斗） ; 转弯半径（不带铲斗） ; 驾驶室宽度
        700 kg = 属具重量 ; 选装配重 ; 倾翻载荷的35% | 20 ° = 爬坡角 ; 最大收斗角（举升最高） ; 接近角
        15 s = 预热时间 | 12 km/h = 行驶速度（低速） ; 低速 ; 倒退速度
    """,
    "wheel_loader": """
        320 L = 液压油 | 500 kg = 推雪板 | 5000 kg = 额定装载质量 ; 最大举升力 ; 最大拖车重量
        16000 kg = 后桥载荷 ; 前桥负荷 ; 桥荷（前）
        6800 mm = 转弯半径（铲斗角） ; 装载机转弯半径，铲斗处于搬运位置 ; 最小通过半径（铲斗）
        2600 mm = 地面到发动机罩顶部的高度 ; 驾驶室地板高度 ; 发动机罩高度
        1100 mm = 提升臂水平时的伸距 ; 7英尺高度卸载距离 ; 动臂水平时最大卸载距离
        3100 mm = 前轴中心到铰接点 ; 前桥到铰接中心 ; 前车轴中心线到连接装置
        150 kN = 举升力 ; 液压提升力 ; 液压举升能力 | 30 ° = 卸料角45° ; 离去角 ; 接近角
        7 s = 后倾时间 ; 预热时间 ; 收斗时间 | 16 MPa = 提升泵先导压力 ; 变矩器进口压力
        38 km/h = 后退速度 ; 后退最高速度 ; 最高倒车速度 | 3 m³ = 侧卸斗容量 ; 轻料斗容量 ; 煤斗容量
        18 t = 拖曳重量 ; 整机拖曳质量 | 1.5 m³ = 燃油舱容积 | 2000 mm = 轮胎中心到前悬 ; 工具箱高度 ; 前悬
        45 ° = 铲斗最大倾角（水平） | 5 km/h = 一档速度 ; Ⅰ档 | 20 MPa = 制动气压 ; 变速箱工作压力 ; 变速油压
    """,
}


def rows(table: dict[str, str], equipment_type: str) -> list[tuple[str, str, str]]:
    """(name or value, label, section) of a type."""
    found = []
    for line in table[equipment_type].strip().splitlines():
        for item in line.split(" | "):
            name, labels = item.strip().split(" = ", 1)
            for label in labels.split(" ; "):
                label, _, section = label.partition(" @ ")
                found.append((name, label, section))
    return found


@pytest.mark.parametrize("equipment_type", WORDINGS)
def test_a_label_is_its_value(equipment_type: str) -> None:
    assert misread(equipment_type, rows(WORDINGS, equipment_type)) == []


@pytest.mark.parametrize("equipment_type", OTHERS)
def test_what_is_nobodys_value(equipment_type: str) -> None:
    assert misread(equipment_type, rows(OTHERS, equipment_type)) == []
