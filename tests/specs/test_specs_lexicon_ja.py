"""Labels of Japanese makers' sheets: each alone is the value it names, and what is nobody's value is not taken."""

from __future__ import annotations

import pytest
from specs_lexicon import misread

# By type, rows of "name = label ; label @ heading above it | name = …".
WORDINGS = {
    "articulated_dump_truck": """
        Net Power = ネット出力 | Gross Power = グロス出力 | Engine Power = 定格出力 @ エンジン
        Main Relief Pressure = ホイストリリーフ圧 @ 油圧装置 | Main Pump Flow = ポンプ吐出量 @ 油圧装置
        Maximum Travel Speed = 前進最高速度 | Overall Length = 全長 | Overall Width = 全幅
        Overall Height = キャブ高さ | Ground Clearance = 最低地上高 | Tyre Diameter = タイヤ外径
        Hoist Cylinder Stroke = ホイストシリンダストローク | Hoist Cylinder Bore = ホイストシリンダ内径
        Hoist Cylinder Rod Diameter = ホイストシリンダロッド径
        Steering Cylinder Stroke = ステアリングシリンダストローク | Steering Cylinder Bore = 操向シリンダ内径
        Main Pump Flow = ダンプポンプ吐出量 | Rated Payload = 積載質量 | Empty Weight = 車両質量（空車時）
        Gross Weight = 総質量（積載時） | Body Capacity Heaped = ダンプボディ容量（山積）
        Body Capacity Struck = 平積容量 | Body Dump Angle = ボディダンプ角（最大） | Body Raise Time = ボディ上昇時間
        Body Lower Time = 下降時間 | Maximum Reverse Speed = 後進最高速度 | Turning Radius = 最小回転半径
        Body Raised Height = ボディ最大上昇時高さ | Loading Height = ローディングハイト
        Dump Clearance = ダンプ時後端地上高 | Body Length Inside = 荷台寸法（内側）長さ
        Body Width Inside = 荷台内幅 | Body Width Outside = 荷台外側幅 | Body Depth Inside = 荷台内法高さ
        Rear Overhang = リヤオーバハング | Front Tread = 前輪トレッド | Rear Tread = 後輪トレッド
        Approach Angle = アプローチ角 | Front Overhang = フロントオーバハング | Articulation Angle = 最大屈折角
        Front Axle to Bogie = 前軸～中軸 | Bogie Axle Spacing = 中車軸～後車軸
        Body Capacity Heaped with Tailgate = テールゲート付山積容量
    """,
    "backhoe_loader": """
        Net Power = 定格出力（ネット） | Gross Power = 定格出力（グロス）
        Engine Power = 定格出力（エンジン） @ エンジン | Main Relief Pressure = メインリリーフ圧 @ 油圧装置
        Main Pump Flow = 油圧ポンプ吐出量 @ 油圧装置 | Maximum Travel Speed = 最高走行速度
        Operating Weight = 機体質量 | Overall Length = 全長（回送時） | Overall Width = 機械全幅
        Overall Height = 機械全高 | Ground Clearance = 最低地上高さ | Wheelbase = ホイールベース
        Tyre Diameter = タイヤ直径 | Loader Lift Cylinder Stroke = リフトシリンダストローク
        Loader Lift Cylinder Bore = ローダリフトシリンダ内径
        Loader Bucket Cylinder Stroke = チルトシリンダストローク
        Loader Bucket Cylinder Bore = ローダバケットシリンダ内径 | Boom Cylinder Stroke = ブームシリンダストローク
        Boom Cylinder Bore = ブームシリンダ内径 | Dipper Cylinder Stroke = アームシリンダストローク
        Dipper Cylinder Bore = バックホウアームシリンダ内径
        Backhoe Bucket Cylinder Stroke = バックホーバケットシリンダストローク
        Backhoe Bucket Cylinder Bore = バックホーバケットシリンダ内径
        Swing Cylinder Stroke = バックホウスイングシリンダストローク | Swing Cylinder Bore = 旋回シリンダ内径
        Loader Hinge Pin Height = ローダヒンジピン高さ | Loader Dump Height = ダンプ高さ
        Loader Dump Reach = 最大上昇時リーチ | Loader Dump Angle = ダンプ角
        Loader Rollback Angle = 地上チルトバック角 | Loader Digging Depth = ローダ掘削深さ
        Loader Breakout Force = 最大掘起力（ローダ） | Loader Lift Arm Breakout Force = リフトアーム掘起力
        Loader Bucket Width = ローダバケット幅 | Loader Bucket Capacity = バケット容量（ローダ）
        Backhoe Bucket Capacity = バケット容量（バックホー） | Loader Raise Time = リフト上昇時間
        Loader Lower Time = ローダ下降時間 | Loader Dump Time = バケットダンプ時間
        Loader Lift Capacity = リフト能力（最大高さ） | Maximum Digging Depth = バックホウ最大掘削深さ
        Maximum Reach at Ground Line = 地上最大掘削半径 | Backhoe Loading Height = 積込高さ
        Backhoe Operating Height = 最大作業高さ | Backhoe Swing Arc = 旋回角
        Backhoe Bucket Rotation = バケット回転角 | Bucket Digging Force = バックホウバケット掘削力
        Dipper Digging Force = 最大掘削力（アーム） | Swing Pivot to Rear Axle = 後車軸～旋回中心
        Stabilizer Spread = アウトリガ張出幅 | Steering Angle = 前輪操舵角 | Front Axle Oscillation = 前軸揺動角
        Turning Radius = 最小旋回半径
    """,
    "dozer": """
        Net Power = ネット定格出力 | Gross Power = グロス定格出力 | Engine Power = 最高出力 @ エンジン
        Main Relief Pressure = 主リリーフ弁セット圧力 @ 油圧装置 | Main Pump Flow = メインポンプ吐出量 @ 油圧装置
        Maximum Travel Speed = 走行速度（前進） | Operating Weight = 機械質量（標準仕様）
        Overall Height = 全高（キャブ） | Ground Clearance = 地上高
        Blade Lift Cylinder Stroke = ブレードリフトシリンダ行程
        Blade Lift Cylinder Bore = ブレードリフトシリンダ内径
        Blade Tilt Cylinder Stroke = チルトシリンダストローク
        Blade Tilt Cylinder Bore = ブレードチルトシリンダ内径
        Ripper Lift Cylinder Stroke = リッパリフトシリンダストローク
        Ripper Lift Cylinder Bore = リッパリフトシリンダ内径 | Shipping Weight = 輸送重量
        Maximum Reverse Speed = 最高走行速度（後進） | Blade Weight = ドーザ質量 | Blade Capacity = 土工板容量（m³）
        Blade Width = 全幅（ブレード） | Blade Height = 土工板高さ（mm） | Blade Digging Depth = 最大掘削深さ
        Blade Lift Height = 最大上げ量 | Maximum Blade Tilt = 最大チルト量 | Blade Tilt Angle = ブレードチルト角
        Blade Pitch Adjustment = ピッチ調整角 | Blade Angle = 最大アングル角 | Length Without Blade = トラクタ全長
        Length with Blade = 全長（ドーザ付） | Width over Trunnions = トラニオン部幅 | Track Gauge = 履帯ゲージ
        Shoe Width = 標準シュー幅 | Width over Tracks = 履帯外幅 | Track Length on Ground = 接地長
        Track Pitch = シューピッチ | Grouser Height = 突起高さ | Track Shoes Each Side = シュー枚数（片側）
        Track Rollers Each Side = トラックローラ数（片側） | Carrier Rollers Each Side = キャリヤローラ（片側）
        Ground Pressure = 接地圧（kPa） | Drawbar Pull = ドローバプル
        Ripper Penetration = リッパ最大掘削深さ @ リッパ | Ripper Lift Height = 最大上昇量 @ リッパ
    """,
    "excavator": """
        Net Power = エンジン出力（ネット） | Gross Power = エンジン出力（グロス）
        Engine Power = 最大出力 @ エンジン | Main Relief Pressure = リリーフ弁設定圧 @ 油圧装置
        Main Pump Flow = 最大吐出量 @ 油圧装置 | Maximum Travel Speed = 最高走行速度
        Operating Weight = 運転質量（キャブ仕様） | Overall Length = 車両全長 | Overall Width = 全幅（クローラ）
        Overall Height = 輸送時全高 | Ground Clearance = 最低地上高（下部走行体）
        Boom Cylinder Stroke = ブームシリンダ行程 | Boom Cylinder Bore = ブームシリンダ径
        Boom Cylinder Rod Diameter = ブームシリンダピストンロッド径
        Boom Cylinder Closed Length = ブームシリンダ最短長 | Arm Cylinder Stroke = アームシリンダストローク
        Arm Cylinder Bore = アームシリンダ内径 | Arm Cylinder Rod Diameter = アームシリンダロッド直径
        Arm Cylinder Closed Length = アームシリンダ最縮長 | Bucket Cylinder Stroke = バケットシリンダストローク
        Bucket Cylinder Bore = バケットシリンダ径 | Bucket Cylinder Rod Diameter = バケットシリンダロッド径
        Bucket Cylinder Closed Length = バケットシリンダ最縮長
        Adjust Cylinder Stroke = アジャストブームシリンダストローク | Adjust Cylinder Bore = アジャストシリンダ内径
        Blade Cylinder Stroke = 排土板シリンダストローク | Blade Cylinder Bore = 排土板シリンダ内径
        Blade Cylinder Rod Diameter = ブレードシリンダロッド径 | Main Relief Pressure = ブーム、アーム、バケット
        Swing Relief Pressure = 旋回圧力 | Travel Relief Pressure = 走行回路リリーフ圧
        Main Pump Flow = 主ポンプ吐出量 | Swing Speed = 旋回速度（最大） | Swing Torque = 旋回トルク
        Travel Speed Low = 低速走行速度 | Drawbar Pull = けん引力 | Counterweight = カウンタウエイト重量
        Bucket Weight = バケット重量 | Bucket Capacity = バケット山積容量 | Bucket Width = バケット外幅
        Bucket Tip Radius = ツース先端半径 | Boom Length = ブーム長さ（標準） | Arm Length = アーム長さ
        Maximum Digging Depth = A 最大掘削深さ
        Maximum Digging Depth 2.44 m Level Bottom = 最大掘削深さ（8ftレベル）
        Maximum Vertical Wall Digging Depth = 最大垂直掘さく深さ | Maximum Digging Height = 最大掘削高
        Maximum Dumping Height = 最大ダンプ高 | Minimum Dumping Height = 最小ダンプ高
        Maximum Reach = 最大掘削リーチ | Maximum Reach at Ground Line = 最大掘削半径（地上）
        Minimum Swing Radius = 作業装置最小旋回半径 | Tail Swing Radius = 上部旋回体後端旋回半径
        Cab Height = キャブ上端高さ（mm） | Height to Handrail = 全高（ハンドレール）
        Upperstructure Width = 上部旋回体全幅（mm） | Track Length = 走行体全長
        Track Length on Ground = 前後タンブラ中心距離 | Track Gauge = クローラゲージ | Shoe Width = ゴムクローラ幅
        Track Height = クローラ高さ | Counterweight Clearance = カウンタウエイト地上高
        Bucket Digging Force = 最大バケット掘削力（ISO） | Arm Digging Force = アーム掘削力（通常）
        Track Shoes Each Side = 履板枚数（片側） | Track Rollers Each Side = 下転輪数（片側）
        Carrier Rollers Each Side = 上転輪数（片側） | Blade Width = ドーザ幅 | Blade Height = ブレード高
        Blade Lift Height = ブレード地上最大上昇量 | Blade Digging Depth = ブレード最大下降量
        Boom Swing Angle Left = ブームスイング角度（左） | Boom Swing Angle Right = ブームスイング右
        Ground Pressure = 接地圧（標準） | Maximum Travel Speed = 走行速度 高 @ 走行速度
        Travel Speed Low = 低速 @ 走行速度
    """,
    "forklift": """
        Net Power = 定格出力 ネット（JIS D 0006-1） | Gross Power = エンジン定格出力（グロス）
        Engine Power = エンジン出力 @ エンジン | Main Relief Pressure = メインリリーフ圧力 @ 油圧装置
        Main Pump Flow = ポンプ最大吐出量 @ 油圧装置 | Operating Weight = 車両重量
        Overall Length = 車両全長（フォーク付） | Overall Width = 機体全幅 | Wheelbase = 軸間距離
        Tyre Diameter = タイヤ径 | Lift Cylinder Stroke = リフトシリンダ行程 | Lift Cylinder Bore = リフトシリンダ径
        Lift Cylinder Rod Diameter = リフトシリンダロッド径
        Free Lift Cylinder Stroke = フリーリフトシリンダストローク
        Free Lift Cylinder Bore = フリーリフトシリンダ内径 | Tilt Cylinder Stroke = チルトシリンダストローク
        Tilt Cylinder Bore = チルトシリンダ内径 | Tilt Cylinder Rod Diameter = チルトシリンダロッド径
        Steering Cylinder Stroke = ステアリングシリンダストローク | Steering Cylinder Bore = パワステシリンダ内径
        Main Relief Pressure = 荷役系リリーフ圧 | Rated Capacity = 荷重（定格） | Load Center = 荷重中心（基準）
        Load Distance = フロントオーバーハング | Axle Load Front Laden = 前車軸荷重（定格荷重時）
        Axle Load Front Unladen = 軸荷重 無負荷時 前輪 | Mast Tilt Forward = チルト角（前）
        Mast Tilt Backward = マスト傾斜角（後傾） | Lowered Mast Height = マスト収縮時全高
        Free Lift Height = フリーリフト高さ | Lift Height = フォーク最大揚高
        Extended Mast Height = マスト上昇時全高 | Overhead Guard Height = オーバーヘッドガード高さ
        Seat Height = 座席高さ | Coupling Height = ドローバ地上高 | Length to Fork Face = 全長（フォークなし）
        Ground Clearance = 最低地上高（フレーム） | Ground Clearance Below Mast = 最低地上高（マスト部）
        Turning Radius = 最小旋回半径（車体最外側） | Front Tread = トレッド（前輪） | Rear Tread = 後輪トレッド
        Fork Length = 標準フォーク長さ | Fork Width = ツメ幅 | Fork Thickness = フォーク（厚さ）
        Fork Carriage Width = フィンガバー幅 | Aisle Width = 直角積み付け通路幅
        Travel Speed Laden = 走行速度（定格荷重時） | Travel Speed Unladen = 最高走行速度（無負荷時）
        Lift Speed Laden = 上昇速度（積載時） | Lift Speed Unladen = 上昇速度（空荷）
        Lowering Speed Laden = リフト下降速度（負荷時） | Lowering Speed Unladen = フォーク下降速度（無負荷時）
        Drawbar Pull = けん引力（負荷時）
    """,
    "grader": """
        Net Power = 正味出力 | Gross Power = 定格出力 グロス | Engine Power = エンジン最高出力 @ エンジン
        Main Relief Pressure = 油圧リリーフ圧 @ 油圧装置 | Main Pump Flow = 主ポンプ最大吐出量 @ 油圧装置
        Maximum Travel Speed = 最高車速 | Operating Weight = 総質量 | Overall Length = 機械全長
        Overall Height = 全高（キャブ） | Wheelbase = 軸距
        Blade Lift Cylinder Stroke = ブレード昇降シリンダストローク
        Blade Lift Cylinder Bore = ブレード昇降シリンダ内径
        Articulation Cylinder Stroke = アーティキュレーションシリンダストローク
        Articulation Cylinder Bore = アーティキュレートシリンダ内径
        Side Shift Cylinder Stroke = 横送りシリンダストローク | Side Shift Cylinder Bore = サイドシフトシリンダ内径
        Maximum Reverse Speed = 最高速度（後進） | Steering Angle = ステアリング角度
        Articulation Angle = アーティキュレート角 | Front Axle Oscillation = フロントアクスル揺動角
        Turning Radius = 最小回転半径 | Wheel Lean Angle = 前輪リーニング角（左／右）
        Moldboard Length = ブレード全長 | Moldboard Height = ブレード高 | Moldboard Thickness = ブレード板厚
        Moldboard Arc Radius = ブレード湾曲半径 | Throat Clearance = ブレードスロートクリアランス
        Circle Rotation = サークル回転角度 | Circle Diameter = サークル直径
        Blade Lift Above Ground = ブレード最大上昇量 | Depth of Cut = ブレード最大切削深さ
        Blade Side Shift Left = 横送り量（左） | Blade Side Shift Right = ブレード横移動量（右）
        Shoulder Reach = 最大ショルダリーチ（タイヤ外側） | Bank Cut Angle = 法切り角度
        Blade Tip Angle Forward = ブレード前傾 | Blade Tip Angle Backward = ブレードチルト角（後）
        Blade Pull = 最大牽引力 | Blade Down Pressure = ブレード押付け力
        Height to Top of Cylinders = 全高（シリンダ上端） | Front Axle Height = フロントアクスル中心高さ
        Tandem Axle Spacing = タンデム軸距 | Front Axle to Articulation = 前車軸～アーティキュレートピン
        Rear Axle to Articulation = タンデム中心～屈折ピン | Front Axle to Moldboard = 前車軸～ブレード
        Tire Centerline Width = 輪距 | Overall Width = 車体幅 | Ripper Penetration = リッパ最大掘削深さ @ リッパ
    """,
    "mobile_crane": """
        Net Power = エンジン定格出力（ネット） | Gross Power = 定格出力（グロス）SAE J1995
        Engine Power = エンジン最大出力 @ エンジン | Main Relief Pressure = リリーフセット圧 @ 油圧装置
        Main Pump Flow = 油圧ポンプ最大吐出量 @ 油圧装置 | Operating Weight = 車両質量 | Overall Length = 全長
        Luffing Cylinder Stroke = ブーム起伏シリンダストローク | Luffing Cylinder Bore = ブーム起伏シリンダ内径
        Luffing Cylinder Rod Diameter = 起伏シリンダロッド径 | Telescoping Cylinder Stroke = 伸縮シリンダストローク
        Telescoping Cylinder Bore = 伸縮シリンダ内径
        Outrigger Jack Cylinder Stroke = アウトリガジャッキシリンダストローク
        Outrigger Jack Cylinder Bore = ジャッキシリンダ内径 | Maximum Lifting Capacity = 最大クレーン容量
        Radius at Maximum Capacity = 最大能力時作業半径 | Maximum Working Radius = 最大作業半径 ブーム
        Boom Length Retracted = ブーム全縮長さ | Boom Length Extended = 最伸ブーム長さ
        Boom Sections = 主ブーム段数 | Boom Telescoping Time = ブーム伸び時間
        Boom Luffing Time = ブーム上げ時間（秒） | Boom Angle Maximum = ブーム起伏角（最大）
        Boom Angle Minimum = ブーム最小起伏角度 | Jib Length = ジブ長さ | Jib Offset Angle = ジブオフセット
        Maximum Tip Height = 最大揚程 | Slewing Speed = 旋回速度（最大）
        Main Winch Line Speed = 主巻ウインチロープ速度 | Main Winch Line Pull = 主巻ロープ最大張力
        Hoist Rope Diameter = ワイヤーロープ直径 | Outrigger Spread Lateral = アウトリガー最大張出幅
        Outrigger Spread Longitudinal = アウトリガ前後中心距離 | Counterweight = 最大カウンタウエイト
        Tail Swing Radius = 上部旋回体後端旋回半径 | Axle Load = 軸荷重 | Maximum Travel Speed = 最高走行速度
        Overall Height = 全高 | Overall Width = 全幅（走行姿勢） | Turning Radius = 最小回転半径（最外輪中心）
        Approach Angle = アプローチ角 | Departure Angle = デパーチャアングル
    """,
    "rigid_dump_truck": """
        Net Power = 定格出力（ネット）（ISO 9249） | Gross Power = 最大出力（グロス）
        Engine Power = 定格出力/回転数 @ エンジン | Main Relief Pressure = ホイストリリーフ弁セット圧 @ 油圧装置
        Main Pump Flow = ポンプ吐出し量 @ 油圧装置 | Wheelbase = ホイールベース（前軸～後軸）
        Hoist Cylinder Stroke = ダンプシリンダ行程 | Hoist Cylinder Bore = ダンプシリンダ内径
        Hoist Cylinder Rod Diameter = ダンプシリンダロッド径 | Steering Cylinder Stroke = 操向シリンダストローク
        Steering Cylinder Bore = 操舵シリンダ内径 | Main Pump Flow = ホイストポンプ吐出量
        Rated Payload = 定格積載質量（公称） | Empty Weight = 空車重量 | Gross Weight = 積車時質量
        Body Capacity Heaped = 荷台容量（山積み 2:1） | Body Capacity Struck = ダンプボディ容量（平積）
        Body Dump Angle = ボディ最大ダンプ角 | Body Raise Time = ホイスト上昇時間
        Body Lower Time = ダンプ時間（下降） | Maximum Travel Speed = 最高速度（前進）
        Maximum Reverse Speed = 最高速度（後進） | Turning Radius = 最小回転半径（外側前輪）
        Overall Height = 全高（キャブ） | Body Raised Height = ベッセル上昇時全高 | Loading Height = 積込み高さ
        Dump Clearance = ダンプ時地上高 | Body Length Inside = 荷台内側長さ | Body Width Inside = ベッセル内幅
        Body Width Outside = ベッセル外幅 | Body Depth Inside = 荷台深さ | Rear Overhang = 後軸から車体後端
        Front Tread = 輪距（前輪） | Rear Tread = リアトレッド | Body Weight = 荷台質量
        Chassis Weight = シャシ重量 | Operating Width = 運転時全幅 | Canopy Width = キャノピー幅
        Front Canopy Height = 全高（プロテクタ） | Body Length Overall = ボディ全長
        Rear Axle Clearance = リヤアクスル地上高 | Engine Guard Clearance = エンジンアンダーガード地上高
    """,
    "skid_steer": """
        Net Power = 正味定格出力 | Engine Power = 定格出力/回転速度 @ エンジン
        Main Relief Pressure = 主リリーフ圧 @ 油圧装置 | Main Pump Flow = 最大流量 @ 油圧装置
        Operating Weight = 機体総質量 | Wheelbase = ホイルベース | Lift Cylinder Stroke = リフトシリンダ行程
        Lift Cylinder Bore = ブームシリンダ内径 | Lift Cylinder Rod Diameter = リフトシリンダロッド径
        Tilt Cylinder Stroke = チルトシリンダストローク | Tilt Cylinder Bore = ダンプシリンダ内径
        Tilt Cylinder Rod Diameter = バケットシリンダロッド径 | Overall Height = 全高（ROPS）
        Overall Width = 全幅（バケットなし） | Hinge Pin Height at Maximum Lift = 最大上昇時ヒンジピン高さ
        Dumping Clearance = ダンプ高さ | Dumping Reach = 最大上昇時リーチ | Dump Angle at Maximum Lift = ダンプ角
        Rack Back at Ground = バケット後傾角 | Digging Depth = 掘削深さ | Breakout Force = 最大掘起力
        Lift Arm Breakout Force = リフトアーム持上げ力 | Bucket Width = バケット外幅
        Bucket Capacity = バケット容量 | Raise Time = リフトアーム上昇 @ サイクルタイム
        Lower Time = 下降時間 @ サイクルタイム | Dump Time = 前傾時間 @ サイクルタイム
        Rated Operating Capacity = 最大荷重 | Tipping Load = 静的転倒荷重 | Length with Bucket = 全長（バケット付）
        Length Without Attachment = 全長（バケットなし） | Turning Radius with Bucket = 旋回半径（前方）
        Turning Radius Rear = 旋回半径（後方） | Departure Angle = デパーチャアングル
        Operating Height Fully Raised = 作業時最大高さ | Auxiliary Flow = 補助油圧流量
    """,
    "wheel_loader": """
        Net Power = 最大出力（ネット） | Engine Power = 機関出力 @ エンジン
        Main Relief Pressure = リリーフ弁セット圧 @ 油圧装置 | Main Pump Flow = 油圧ポンプ流量 @ 油圧装置
        Operating Weight = 整備質量 | Lift Cylinder Stroke = リフトシリンダーストローク
        Tilt Cylinder Stroke = バケットシリンダストローク | Steering Cylinder Stroke = ステアリングシリンダ行程
        Lift Cylinder Bore = リフトシリンダチューブ内径 | Tilt Cylinder Bore = チルトシリンダ内径
        Steering Cylinder Bore = ステアリングシリンダ内径 | Lift Cylinder Rod Diameter = ブームシリンダロッド径
        Tilt Cylinder Rod Diameter = チルトシリンダロッド径
        Steering Cylinder Rod Diameter = ステアリングシリンダピストンロッド径
        Lift Cylinder Closed Length = リフトシリンダ最縮長さ | Tilt Cylinder Closed Length = チルトシリンダ最縮長
        Steering Cylinder Closed Length = ステアリングシリンダ最縮長 | Main Relief Pressure = 作業機最高圧力
        Steering Relief Pressure = ステアリングリリーフ圧 | Main Pump Flow = 作業機油圧ポンプ吐出量
        Steering Pump Flow = 操向ポンプ吐出量 | Raise Time = 上昇時間（積荷時） @ 作業サイクルタイム
        Dump Time = バケットダンプ時間 @ 作業サイクルタイム | Lower Time = 下げ時間 @ 作業サイクルタイム
        Total Cycle Time = サイクルタイム合計 @ 作業サイクルタイム | Bucket Weight = バケット重量
        Counterweight Weight = カウンターウエイト質量 | Static Tipping Load Straight = 静的転倒荷重 直進時
        Static Tipping Load Full Turn = 静的転倒荷重（フルターン40°） | Breakout Force = 最大掘削力
        Rimpull = 最大駆動力 | Maximum Travel Speed = 前進最高速度 | Maximum Steering Angle = 最大車体屈折角度
        Steering Angle = 屈折角度 | Rear Axle Oscillation = リヤアクスル総揺動角
        Rear Axle Oscillation Each Way = リヤアクスル揺動角± | Wheelbase = 軸距 | Tread = 左右タイヤ中心間距離
        Hinge Pin Height at Maximum Lift = バケットヒンジピン最大高さ
        Hinge Pin Height at Carry = Bピン高さ（運搬時） | Rack Back at Ground = チルトバック角（地上時）
        Rack Back at Carry = バケット後傾角（運搬時） | Rack Back at Maximum Lift = バケット後傾角（最高位置）
        Dump Angle at Maximum Lift = バケット前傾角 | Dumping Clearance = ダンピングクリアランス（45°ダンプ時）
        Dumping Reach = ダンプリーチ | Lift Arm Clearance at Maximum Lift = リフトアームクリアランス
        Digging Depth = 掘削深さ | Overall Length = 車両全長（バケット接地時）
        Overall Length Without Bucket = 全長（バケット除く） | Overall Height = キャブ上端高さ
        Overall Operating Height = 全高（バケット最大上昇） | Overall Width = タイヤ外側幅
        Bucket Width = バケット刃先幅 | Ground Clearance = 地上高 | Hitch Height = ドローバ高さ
        Height to Top of Stack = 全高（排気管上端） | Axle Height = 車輪中心高さ
        Rear Overhang = 後輪中心～車体後端 | Rear Axle to Hitch = 後車軸中心～屈折中心
        Turning Radius = 最小回転半径（タイヤ最外側） | Bucket Capacity Heaped = 定格バケット容量
        Bucket Capacity Struck = 容量（平積） | Tyre Width = タイヤ総幅 | Raise Time = ブーム上げ時間 @ 作業機速度
        Lower Time = バケット下降時間（空荷時） @ 作業機速度 | Dump Time = バケットダンプ（積載時） @ 作業機速度
        Engine Power = エンジン定格出力/回転速度
    """,
}
OTHERS = {
    "articulated_dump_truck": """
        120 mm = 内径 @ エンジン | 132 mm = 気筒内径 | 12 L = 総排気量
        320 L = アドブルータンク容量 ; 燃料タンク容量 | 900 Nm = 最大トルク @ エンジン | 2.5 kW = スタータ出力
        5.5 kW = 始動電動機出力 | 3.9 MPa = パイロット圧 | 12 MPa = ブレーキ圧力 | 350 kPa = タイヤ空気圧
        40 L/min = パイロットポンプ吐出量 | 12 km/h = 前進1速 | 30 ° = 登坂能力
        15000 kg = 前軸荷重（空車時） ; 質量配分 前軸（積車） ; 後輪質量配分（積車） | 45 ° = キャブチルト角
        30 m³ = 山積容量（3:1） | 12 m = 最小回転半径（車体最外側） ; 旋回直径 | 2500 mm = ステップ高さ ; キャブ幅
        20 mm = ボディ底板厚さ ; 底板厚さ | 150 mm = サスペンションシリンダ内径 ; サスペンションストローク
    """,
    "backhoe_loader": """
        120 mm = シリンダ径 @ エンジン | 132 mm = シリンダ内径（エンジン） | 12 L = 排気量 | 320 L = 燃料タンク
        900 Nm = エンジン最大トルク @ エンジン | 2.5 kW = 始動電動機 | 5.5 kW = セルモータ出力
        3.9 MPa = パイロット圧力 | 12 MPa = ファン回路圧力 | 350 kPa = 空気圧 | 40 L/min = ファンポンプ吐出量
        12 km/h = 前進 1速 | 30 ° = 最大登坂能力 | 75 kg = 運転員質量 | 500 kg = タイヤ質量
        2200 mm = 前輪トレッド ; スタビライザ格納幅 ; アウトリガ格納時幅 | 3500 kg = 前軸荷重 ; 吊り能力 ; 後軸荷重
    """,
    "dozer": """
        120 mm = 行程 @ エンジン | 132 mm = ブレーキディスク径 | 12 L = エンジンオイル量 | 320 L = 作動油タンク容量
        900 Nm = 定格トルク @ エンジン | 2.5 kW = スターティングモータ | 5.5 kW = 起動電動機
        3.9 MPa = 操作回路圧力 | 12 MPa = アキュムレータ圧力 | 350 kPa = 前輪空気圧
        40 L/min = ブレーキポンプ吐出量 | 12 km/h = 後進1速 | 30 ° = 切削角 ; 登坂能力 ; 登坂角度
        75 kg = オペレータ質量 | 500 kg = キャブ質量 | 4000 mm = 最小旋回半径 ; 履帯全長 ; 最小回転半径
        1200 mm = 起動輪径 ; リッパビーム幅 ; ビーム幅 | 2.6 m² = 接地面積
        100 kN = リッパ貫入力 ; リッパ引抜力 ; ブレード押付力 | 3000 kg = ウインチ質量 ; トーイングウインチ質量
        55 ° = 切削角 ; 刃先角 ; ブレード切削角 | 3 = 変速段数 ; リッパ本数 ; シャンク数
    """,
    "excavator": """
        120 mm = ストローク @ エンジン | 132 mm = クラッチ板外径 | 12 L = 冷却水容量 | 320 L = 作動油タンク
        900 Nm = 最大トルク/回転数 @ エンジン | 2.5 kW = オルタネータ出力 | 12 MPa = ブレーキ作動圧
        40 L/min = 操作用ポンプ吐出量 | 12 km/h = 前進2速 | 500 kg = ROPSキャブ質量
        2900 mm = エンジンフード上端高さ @ 寸法 ; エンジンカバー高さ @ 寸法 ; ボンネット高さ @ 寸法
        2500 mm = クローラ内側間隔 ; ブーム幅 ; キャブ幅
        5000 mm = 最大ダンプ時半径 ; アーム輸送長さ ; 最大ダンプ高さ時半径
        34 MPa = ブレーカ回路圧力 ; パワーブースト時リリーフ圧 ; 昇圧時リリーフ圧
        150 kN = 旋回ブレーキ力 ; アーム掘削力（パワーアップ時） ; バケット掘削力（昇圧時）
        1500 kg = 定格荷重 ; 定格総荷重 ; つり上げ荷重
        60 L/min = 旋回ポンプ吐出量 ; ブレード用ポンプ吐出量 ; ギヤポンプ吐出量 | 4.1 km/h = 中速 ; 走行速度（中速）
        2100 mm = 最小通路幅 ; 運搬時幅（縮小時）
        600 mm = アイドラ径 ; スイング時オフセット量（左） ; ブームオフセット量 | 7 ° = 掘削角度 ; 旋回角度
        700 mm = オフセット量 右 ; 最大オフセット量 ; ブームオフセット量（左）
        200 mm = シュー突起高さ ; シューピッチ ; アイドラ幅
        50 L/min = アタッチメント流量 ; AUX流量 ; 排土板ポンプ吐出量
    """,
    "forklift": """
        120 mm = 内径×行程 @ エンジン | 320 L = 作動油量 | 900 Nm = 機関最大トルク @ エンジン | 2.5 kW = 発電機容量
        12 MPa = チャージ圧力 | 40 L/min = 冷却ファンポンプ流量 | 12 km/h = 2速
        3000 kg = 後軸重（空車時） ; カウンタウエイト質量 ; 後輪荷重（無負荷時）
        1200 mm = フォーク外側間隔 ; フォーク開き幅 ; リヤオーバハング
        16 MPa = アタッチメント用圧力 ; アタッチメント回路圧力
        14 kW = ステアリングモータ出力 ; 荷役用モータ出力 ; 走行モータ出力
        10 kN = 最大けん引力（無負荷時） ; けん引力（無負荷時）
        3500 mm = 直角旋回通路幅 ; 交差通路幅 ; 直角交差通路幅 | 500 kg = フォーク質量 | 0.5 m/s = リーチ速度
        1100 mm = 最小内側旋回半径 ; 内側旋回半径
        2000 kg = 後軸重（負荷時） ; 標準バッテリ質量 ; バッテリ質量（最小）
        1000 mm = フォーク調整範囲 ; フォーク最大開き ; ステップ高さ
        10 kW = 荷役用モータ ; ドライブモータ出力 ; ポンプモータ出力
    """,
    "grader": """
        120 mm = 気筒径 @ エンジン | 320 L = 冷却水量 | 12 MPa = トランスミッション油圧 | 12 km/h = 前進３速
        75 kg = 燃料質量 | 500 kg = 追加カウンタウエイト質量
        250 mm = スカリファイヤ掘削深さ ; 切刃幅 ; カッティングエッジ幅
        500 mm = タンデムケース高さ ; サークルサイドシフト量 ; ドローバ横送り量
        15 ° = タンデム揺動角度 ; タンデム揺動角 | 5000 kg = 前輪荷重 ; 質量配分（前輪） ; スカリファイヤ質量
        60 kN = スカリファイヤ押付力 ; リッパ貫入力 | 2500 mm = スノープラウ幅 ; ドーザ幅 ; リッパ幅
    """,
    "mobile_crane": """
        320 L = 尿素水タンク容量 | 4000 kg = 前軸重 ; 後軸重 ; シングルトップ吊上能力
        12000 mm = 最小回転半径（ブーム先端） ; ジブ最大地上揚程 ; 最大地上揚程（ジブ）
        20 kN = 補巻ロープ張力 ; ワイヤロープ破断荷重 ; 補巻ラインプル | 2 m/s = 補巻巻上速度 ; 補巻ロープ速度
        20 s = アウトリガ張出時間 ; ブーム縮め時間 ; ジャッキ伸長時間 | 180 m = ワイヤロープ長さ ; 主巻ロープ長さ
        2400 mm = 前輪トレッド ; リヤオーバハング ; トレッド
        4500 mm = アウトリガ張出幅（中間） ; アウトリガ張出幅（最小） ; アウトリガ最小張出幅 | 4 = 軸数
        5 t = ジブ最大定格総荷重 ; 補フック質量 ; 主フック質量
        30 m = 補巻ロープ長さ ; ジブ最大作業半径 ; 最大作業半径（ジブ）
        60 s = ブーム縮め時間 ; アウトリガ格納時間 ; ブーム伏せ時間
    """,
    "rigid_dump_truck": """
        320 L = 作動油全量 | 15000 kg = 前軸質量（積載時） ; 後軸荷重（積車時） ; 後軸重 | 45 ° = 揺動角
        12 m = 最小旋回半径（車体最外側） | 2500 mm = タイヤ幅 ; ボンネット高さ | 20 mm = 側板厚さ
        150 mm = フロントサスペンションシリンダストローク | 3000 mm = タイヤ外径差
    """,
    "skid_steer": """
        320 L = 油圧タンク（全量） | 120 L/min = 大流量仕様 ; 補助油圧（ハイフロー） ; 高流量
        1500 mm = トレッド ; キャブ幅 ; シート高さ | 20 ° = アプローチアングル ; 最大上昇時後傾角
        700 kg = アタッチメント質量
    """,
    "wheel_loader": """
        320 L = 燃料 | 500 kg = 追加ウエイト | 5000 kg = 定格積載質量 ; 常用荷重 ; 常用積載質量
        16000 kg = 後輪荷重（空車時） ; 前軸質量 ; 前軸荷重
        6800 mm = 最小回転半径（バケット最外側） ; 最小回転半径（車体最外側） ; 最小回転半径（内輪）
        2600 mm = シート高さ ; リヤフェンダ幅 ; ボンネット上端高さ
        1100 mm = リフトアーム水平時リーチ ; 水平時リーチ ; リーチ（2.1mクリアランス時）
        3100 mm = 前輪中心～センターピン ; 前車軸中心～ヒッチピン
        150 kN = 最大持上力 ; 持上げ力 ; リフトアーム持上力 | 7 s = 後傾時間 ; バケット後傾時間 ; ステアリング時間
        38 km/h = 最高速度（後進） ; 後進最高速度 ; 後進速度
        3 m³ = 除雪バケット容量 ; チップバケット容量 ; 軽量バケット容量 | 5300 mm = 最小通路幅 ; 内輪旋回半径
        5.0 t = 定格荷重（常用荷重） ; けん引荷重
        1500 mm = カウンタウエイト幅 ; フロントオーバハング ; バケット奥行 | 35 km/h = 後進3速 ; 前進4速
        90 dB = 周囲騒音 | 25 MPa = 走行系リリーフ圧 ; ブレーキアキュムレータ圧 ; トルコン圧力
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
